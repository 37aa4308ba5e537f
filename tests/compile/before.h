/* What may stand before tribox.h in somebody's file, for `-include tests/compile/before.h -DBEFORE_...`: other
 * headers, their macros, an open #pragma pack, or a compiler that is neither gcc nor clang. The system's headers
 * are read first, so that only ours sees it. */
#if defined(BEFORE_WINDOWS)
#include <windows.h>
#endif
#if !defined(GOLDEN_FREESTANDING)
#include <fenv.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#endif
#include <float.h>
#include <stddef.h>
#include <stdint.h>
#if defined(BEFORE_TERM) /* curses' names for the terminal: lines, columns, ... */
#include <curses.h>
#include <term.h>
#endif

/* Qt's keywords, as <qobjectdefs.h> defines them. */
#if defined(BEFORE_QT)
#define emit
#define slots
#define signals public
#define foreach for
#define forever for (;;)
#endif

/* MSVC's branches, on a compiler that has its words or gets them here. */
#if defined(BEFORE_MSVC)
#define BEFORE_NO_GNU
#ifndef _MSC_VER
#define _MSC_VER 1940
#endif
#ifndef __declspec
#define __declspec(what)
#endif
#define __inline inline
#define __forceinline inline
#define _ReadWriteBarrier() ((void)0)
#define __unaligned /* x86 reads anywhere; with -fno-strict-aliasing, as MSVC does not reason about types */
#endif

/* A compiler that nobody has heard of. */
#if defined(BEFORE_NO_GNU)
#define GOLDEN_ASM /* the tests' own */
#undef __GNUC__
#undef __GNUC_MINOR__
#undef __clang__
#undef __clang_major__
#endif

#if defined(BEFORE_PACK)
#if BEFORE_PACK == 1
#pragma pack(push, 1)
#else
#pragma pack(push, 4)
#endif
#endif
