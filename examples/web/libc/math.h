/* math.h - see libc.h */
#include "libc.h"
