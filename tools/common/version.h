/* SPDX-License-Identifier: 0BSD */
/* The version that every host program prints for --version. */
#ifndef OLDWELL_TOOLS_COMMON_VERSION_H
#define OLDWELL_TOOLS_COMMON_VERSION_H

#define OLDWELL_VERSION "0.1.0"

#endif
