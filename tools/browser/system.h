/* system.h -- what the C library of Debian's emscripten lacks; each file of libqdot begins with it. */
#ifndef QDOT_BROWSER_SYSTEM_H
#define QDOT_BROWSER_SYSTEM_H

#include <stddef.h>

void qsort_r(void *base, size_t n, size_t size, int (*compare)(const void *, const void *, void *), void *user);

#endif
