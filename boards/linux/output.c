/* SPDX-License-Identifier: 0BSD */
/* The kinds of displays. */
#include "output.h"

#include <stddef.h>

static const struct output_kind *const kinds[] = {
    [PANEL_FBDEV] = &output_fbdev,
#ifdef OLDWELL_DRM
    [PANEL_DRM] = &output_drm,
#else
    [PANEL_DRM] = NULL,
#endif
    [PANEL_V4L2] = &output_v4l2,
    [PANEL_FILE] = &output_file,
};

const struct output_kind *output_kind_of(const struct oldwell_settings *settings)
{
    return settings->panel < PANEL_COMMAND ? kinds[settings->panel] : &output_command;
}

int output_open(struct output *output, const struct oldwell_settings *settings,
                const struct linux_system *system)
{
    static struct linux_fault not_built;
    const struct output_kind *kind = output_kind_of(settings);
    *output = (struct output){ .kind = kind, .fault = &not_built, .fd = -1 };
    if (kind == NULL) {
        return linux_fault_note(&not_built, OW_UNSUPPORTED, panel_kind_name(settings->panel), NULL,
                                "this program was built without it", "choose another --panel");
    }
    int status = kind->open(output, settings, system);
    output->is_open = status == OW_OK;
    return status;
}

void output_close(struct output *output)
{
    if (output->is_open) {
        output->kind->close(output);
        output->is_open = false;
    }
}

int output_look(struct output *output)
{
    return output->kind->look == NULL ? OW_OK : output->kind->look(output);
}

int output_finish(struct output *output)
{
    return output->kind->finish == NULL ? OW_OK : output->kind->finish(output);
}
