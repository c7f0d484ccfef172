/* SPDX-License-Identifier: 0BSD */
/* Reading a tree's file without ending the program. */
#include "tree.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_blob.h"

enum { FIRST_BYTES = 1 << 16 };

/* Reads to the end; NULL: why says what went wrong. */
static void *read_stream(FILE *stream, size_t *bytes, char *why, size_t why_bytes)
{
    size_t capacity = FIRST_BYTES;
    char *memory = malloc(capacity);
    *bytes = 0;
    while (memory != NULL) {
        *bytes += fread(memory + *bytes, 1, capacity - *bytes, stream);
        if (ferror(stream) != 0 || *bytes > OW_MAX_BLOB_BYTES) {
            snprintf(why, why_bytes, "%s",
                     ferror(stream) != 0 ? strerror(errno) : "larger than a tree can be");
            free(memory);
            return NULL;
        }
        if (*bytes < capacity) {
            return memory;
        }
        capacity *= 2;
        char *larger = realloc(memory, capacity);
        if (larger == NULL) {
            free(memory);
        }
        memory = larger;
    }
    snprintf(why, why_bytes, "not enough memory to read it");
    return NULL;
}

static const char *remedy(enum ow_status status)
{
    return status == OW_MAGIC     ? ", compile the model with owc first"
           : status == OW_VERSION ? ", compile it with the owc of this version"
                                  : ", copy or compile it again";
}

bool loaded_tree_read(struct loaded_tree *tree, const char *file, char *why, size_t why_bytes)
{
    size_t bytes;
    *tree = (struct loaded_tree){ 0 };
    FILE *stream = fopen(file, "rb");
    if (stream == NULL) {
        snprintf(why, why_bytes, "cannot read: %s", strerror(errno));
        return false;
    }
    tree->bytes = read_stream(stream, &bytes, why, why_bytes);
    fclose(stream);
    if (tree->bytes == NULL) {
        return false;
    }
    enum ow_status status = ow_tree_open(&tree->tree, tree->bytes, (uint32_t)bytes);
    if (status != OW_OK) {
        snprintf(why, why_bytes, "%s%s", ow_status_text(status), remedy(status));
        loaded_tree_free(tree);
        return false;
    }
    return true;
}

void loaded_tree_free(struct loaded_tree *tree)
{
    free(tree->bytes);
    *tree = (struct loaded_tree){ 0 };
}
