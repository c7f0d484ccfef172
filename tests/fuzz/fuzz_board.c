/* SPDX-License-Identifier: 0BSD */
/* Any bytes as a board file: each setting lies in the text and has a name, a value, a line. */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "boards/linux/board_file.h"
#include "tests/fuzz/fuzz.h"

static void insist(bool so)
{
    if (!so) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    size_t at = 0;
    long line = 0;
    long last = 0;
    struct board_setting setting;
    const char *wrong;
    if (text == NULL || size > BOARD_FILE_BYTES_MAX) {
        free(text);
        return 0;
    }
    memcpy(text, data, size);
    while (board_file_next(text, size, &at, &line, &setting, &wrong)) {
        insist(wrong == NULL && setting.line > last && setting.line == line);
        insist(setting.name >= text && setting.name + strlen(setting.name) < text + size);
        insist(setting.value > setting.name &&
               setting.value + strlen(setting.value) <= text + size);
        insist(setting.name[0] != '\0' && setting.value[0] != '\0');
        last = setting.line;
    }
    insist(wrong != NULL || at >= size);
    free(text);
    return 0;
}
