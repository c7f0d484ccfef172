/* SPDX-License-Identifier: 0BSD */
/* The strongly connected components of the obstruction relation, in order. */
#ifndef OWC_OBSTRUCTION_COMPONENTS_H
#define OWC_OBSTRUCTION_COMPONENTS_H

#include <stdint.h>

#include "obstruction_faces.h"

/* Component i: faces[starts[i]] .. faces[starts[i + 1] - 1]. Hidden before hiding. */
struct components {
    uint32_t *faces;
    uint32_t *starts;
    uint32_t count;
};

void components_find(struct components *components, struct obstruction_set *set);
void components_free(struct components *components);

#endif
