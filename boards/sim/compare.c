/* SPDX-License-Identifier: 0BSD */
/* --compare: frames against the pictures of a folder. */
#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "output.h"
#include "tools/common/fail.h"

enum { PATH_BYTES = 2 * PATTERN_BYTES + 64 };

static const char *base_name(const char *file)
{
    const char *slash = strrchr(file, '/');
    return slash != NULL ? slash + 1 : file;
}

/* Length of a base name without its extension. */
static int stem_length(const char *base)
{
    const char *dot = strrchr(base, '.');
    return dot != NULL && dot != base ? (int)(dot - base) : (int)strlen(base);
}

static void join(char path[PATH_BYTES], int folder_length, const char *folder, const char *base,
                 const char *what, const char *extension)
{
    int length = snprintf(path, PATH_BYTES, "%.*s%s%.*s%s%s", folder_length, folder,
                          folder_length > 0 ? "/" : "", stem_length(base), base, what, extension);
    if (length < 0 || length >= PATH_BYTES) {
        fail(FAIL_INPUT, base, 0, "the file's name gets too long");
    }
}

/* Opens the reference, whatever format it has; NULL if there is none. */
static FILE *open_reference(const struct settings *settings, const char *base,
                            char path[PATH_BYTES], const struct image_format **format)
{
    for (uint32_t i = 0; (*format = image_format_at(i)) != NULL; i++) {
        join(path, (int)strlen(settings->compare), settings->compare, base, "",
             (*format)->extension);
        FILE *stream = fopen(path, "rb");
        if (stream != NULL) {
            return stream;
        }
        if (errno != ENOENT && errno != ENOTDIR) {
            fail(FAIL_INPUT, path, 0, "cannot read: %s", strerror(errno));
        }
    }
    return NULL;
}

/* False: there is no reference. A reference that cannot be read ends the program. */
static bool read_reference(const struct settings *settings, const char *base,
                           struct image *expected)
{
    char path[PATH_BYTES];
    struct image_error error;
    const struct image_format *format;
    FILE *stream = open_reference(settings, base, path, &format);
    if (stream == NULL) {
        return false;
    }
    if (!format->read(stream, expected, &error)) {
        fail(FAIL_INPUT, path, 0, "%s", error.text);
    }
    fclose(stream);
    return true;
}

static void write_beside(const struct settings *settings, const char *name, const char *what,
                         const struct image *image)
{
    char path[PATH_BYTES];
    const struct image_format *format = image_format_at(0);
    const char *base = base_name(name);
    const char *folder = settings->diff_dir;
    int length = folder != NULL ? (int)strlen(folder) : 0;
    if (folder == NULL && base != name) { /* beside -o */
        folder = name;
        length = (int)(base - name) - 1;
        length = length == 0 ? 1 : length;
    }
    join(path, length, folder != NULL ? folder : "", base, what, format->extension);
    write_picture(path, format, image);
}

bool compare_frame(const struct settings *settings, const char *name, const struct image *actual)
{
    const char *base = base_name(name);
    struct image expected;
    struct image difference;
    struct image_error error;
    if (!read_reference(settings, base, &expected)) {
        printf("%.*s: there is no picture to compare with\n", stem_length(base), base);
        write_beside(settings, name, "-actual", actual);
        return false;
    }
    uint64_t count = image_count_differences(actual, &expected);
    bool same_size = actual->width == expected.width && actual->height == expected.height;
    printf("%.*s: %" PRIu64 " pixels differ%s\n", stem_length(base), base, count,
           same_size ? "" : ", the sizes differ");
    if (count > 0) {
        if (!image_difference(&difference, actual, &expected, &error)) {
            fail(FAIL_INPUT, name, 0, "%s", error.text);
        }
        write_beside(settings, name, "-actual", actual);
        write_beside(settings, name, "-diff", &difference);
        image_free(&difference);
    }
    image_free(&expected);
    return count == 0;
}
