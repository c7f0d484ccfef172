/* SPDX-License-Identifier: 0BSD */
/*
 * Closed solids that the models are put together from. Each call makes one part of the mesh.
 * All of them are built in the coordinates of mesh->place.
 */
#ifndef OLDWELL_TOOLS_OWGEN_SOLIDS_H
#define OLDWELL_TOOLS_OWGEN_SOLIDS_H

#include "tools/owgen/mesh.h"

/* A point of a lathe's profile; the material is that of the surface from here to the next. */
struct lathe_point {
    double radius;
    double height;
    int material;
};

/*
 * A solid of revolution about the y axis with `sides` flat sides; the middle of one side points
 * to +z. The profile starts and ends on the axis (radius 0) and runs counter-clockwise, that is
 * up on the outside. Where it starts or ends level, the cap is one polygon.
 * Polygons: sides x (sections that are not level caps) + level caps.
 */
void solid_lathe(struct mesh *mesh, const char *name, int sides, const struct lathe_point *profile,
                 size_t count);

/* A cylinder about the y axis from height `bottom` to `top`: sides + 2 polygons. */
void solid_cylinder(struct mesh *mesh, const char *name, int material, int sides, double radius,
                    double bottom, double top);

/* A box between two corners, low ones first: 6 polygons. */
void solid_box(struct mesh *mesh, const char *name, int material, const double low[3],
               const double high[3]);

/* A box of size w x h x d that stands on (x, y, z), the middle of its lower side: 6 polygons. */
void solid_block(struct mesh *mesh, const char *name, int material, const double foot[3],
                 const double size[3]);

/* A point in the plane of a prism's outline. */
struct flat_point {
    double x, y;
};

/* An outline, counter-clockwise around the solid; a hole runs clockwise. */
struct outline {
    const struct flat_point *points;
    size_t count;
};

/* Materials of a prism's three kinds of sides. */
struct prism_paint {
    int front; /* the face at the far end of z, which looks along +z */
    int back;  /* the face that looks along -z */
    int side;  /* all others, those of holes included */
};

/* At most this many points in an outline with all its holes and bridges. */
enum { PRISM_POINTS = 128 };

/*
 * An outline (concave if you like) pulled along z from `back` to `front`, with holes right
 * through it. Front and back are one polygon each.
 * Polygons: points of the outline and of all holes + 2.
 */
void solid_prism(struct mesh *mesh, const char *name, struct prism_paint paint,
                 struct outline outline, const struct outline *holes, size_t hole_count,
                 double back, double front);

/* A picture frame: the space between two rectangles, mitred, from `back` to `front`: 16. */
void solid_frame(struct mesh *mesh, const char *name, int material,
                 const struct flat_point outer[2], const struct flat_point inner[2], double back,
                 double front);

#endif
