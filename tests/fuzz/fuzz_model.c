/* SPDX-License-Identifier: 0BSD */
/*
 * Any bytes as an OBJ file: the reader must not crash, and what it reads must
 * compile to a tree that the core takes, or be refused with a reason.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_tree.h"
#include "tests/fuzz/fuzz.h"
#include "tools/owc/compile.h"
#include "tools/owc/import.h"

/* Keeps one input to a few milliseconds. */
enum { MOST_BYTES = 1 << 16, MOST_POLYGONS = 200, MOST_CORNERS = 2000 };

static _Noreturn void found(const char *what)
{
    fprintf(stderr, "fuzz_model: %s\n", what);
    abort();
}

/* Without the crossing of everything with everything: the time is bounded. */
static void compile(const struct model *model, const struct compile_options *options)
{
    struct blob blob;
    struct compile_stats stats;
    struct problem problem;
    struct ow_tree tree;
    if (compile_model(&blob, &stats, model, options, &problem)) {
        if (ow_tree_open(&tree, blob.bytes, blob.size) != OW_OK) {
            found("the core refuses the tree");
        }
    } else if (problem.text[0] == '\0' || strstr(problem.text, "defect") != NULL) {
        found(problem.text);
    }
    blob_free(&blob);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct model model;
    struct problem problem;
    if (size > MOST_BYTES) {
        return 0;
    }
    bool fine = import_memory(&model, data, size, "obj", &problem);
    if (!fine && problem.text[0] == '\0') {
        found("refused without a reason");
    }
    if (fine && model.polygon_count <= MOST_POLYGONS && model.corner_count <= MOST_CORNERS) {
        struct compile_options options = {
            .select = BSP_KEDEM,
            .candidates = 3,
            .sides = SIDES_AUTO,
            .tolerance_q8 = size % 3 == 0   ? 0
                            : size % 3 == 1 ? 256
                                            : 33 * 256,
            .keep_ids = size % 2 == 0,
            .keep_normals = size % 5 == 0,
        };
        compile(&model, &options);
    }
    import_free(&model);
    return 0;
}
