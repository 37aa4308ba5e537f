/* stdio.h - what the examples' file readers and writers need of it, for a page without a C library: one file at a
 * time, in memory. libc.h says it whole. */
#include "libc.h"
