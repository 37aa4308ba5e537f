/* libc.h - the part of the C library that mesh_io.h and voxel_io.h use, for WebAssembly without one
 *
 * Memory comes from the end and is not given back: the page makes a new instance for each mesh. A file that is written
 * stays in memory, for the page to take; none can be read. Decimals are read and printed by JavaScript, whose rules
 * are exact (see page.js: text_number, number_text).
 */
#ifndef WEB_LIBC_H
#define WEB_LIBC_H
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#define WEB_IMPORT(name) __attribute__((import_module("page"), import_name(#name)))
WEB_IMPORT(text_number) double web_text_number(const char *text, int is_float, int *out_length);
WEB_IMPORT(number_text) int web_number_text(double x, int kind, int digits, char *out);
WEB_IMPORT(power) double pow(double x, double y);
WEB_IMPORT(sine) double sin(double x);
WEB_IMPORT(cosine) double cos(double x);

#define HUGE_VAL __builtin_huge_val()
#define HUGE_VALF __builtin_huge_valf()
#define floor __builtin_floor
#define ceil __builtin_ceil
#define fabs __builtin_fabs
#define sqrt __builtin_sqrt
#define abs __builtin_abs

/* ---- Memory and text */

extern unsigned char __heap_base;
static uintptr_t web_end;               /* of what is given out */
static uintptr_t web_latest;            /* where the last piece begins */

static inline int web_reach(uintptr_t end) {
    uintptr_t have = (uintptr_t)__builtin_wasm_memory_size(0) << 16;
    return end <= have || __builtin_wasm_memory_grow(0, (end - have + 65535) >> 16) != SIZE_MAX;
}

static inline void *malloc(size_t size) {
    uintptr_t at = ((web_end ? web_end : (uintptr_t)&__heap_base) + 15) & ~(uintptr_t)15;
    if (size > UINT32_MAX - 65536 - at || !web_reach(at + size)) {
        return NULL;
    }
    web_latest = at;
    web_end = at + size;
    return (void *)at;
}

static inline void free(void *piece) {
    if (piece && (uintptr_t)piece == web_latest) {
        web_end = web_latest;
    }
}

static inline void *memcpy(void *to, const void *from, size_t size) {
    return __builtin_memcpy(to, from, size);
}

static inline void *memmove(void *to, const void *from, size_t size) {
    return __builtin_memmove(to, from, size);
}

static inline void *memset(void *to, int byte, size_t size) {
    return __builtin_memset(to, byte, size);
}

/* The last piece grows where it is; another is copied, as far as memory reaches. */
static inline void *realloc(void *piece, size_t size) {
    void *grown;
    size_t old;
    if (piece && (uintptr_t)piece == web_latest) {
        if (size > UINT32_MAX - 65536 - web_latest || !web_reach(web_latest + size)) {
            return NULL;
        }
        web_end = web_latest + size;
        return piece;
    }
    old = web_end - (uintptr_t)piece;
    grown = malloc(size);
    return grown && piece ? memcpy(grown, piece, size < old ? size : old) : grown;
}

static inline void *calloc(size_t count, size_t size) {
    void *piece = size && count > UINT32_MAX / size ? NULL : malloc(count * size);
    return piece ? memset(piece, 0, count * size) : NULL;
}

static inline int memcmp(const void *a, const void *b, size_t size) {
    const unsigned char *p = (const unsigned char *)a;
    const unsigned char *q = (const unsigned char *)b;
    size_t i = 0;
    while (i < size && p[i] == q[i]) {
        i++;
    }
    return i < size ? p[i] - q[i] : 0;
}

static inline void *memchr(const void *from, int byte, size_t size) {
    const unsigned char *p = (const unsigned char *)from;
    for (; size > 0; size--, p++) {
        if (*p == (unsigned char)byte) {
            return (void *)(uintptr_t)p;
        }
    }
    return NULL;
}

static inline size_t strlen(const char *text) {
    size_t n = 0;
    while (text[n]) {
        n++;
    }
    return n;
}

static inline int strncmp(const char *a, const char *b, size_t size) {
    size_t i = 0;
    while (i < size && a[i] && a[i] == b[i]) {
        i++;
    }
    return i < size ? (unsigned char)a[i] - (unsigned char)b[i] : 0;
}

static inline int strcmp(const char *a, const char *b) {
    return strncmp(a, b, SIZE_MAX);
}

static inline char *strchr(const char *text, int c) {
    return (char *)memchr(text, c, strlen(text) + 1);
}

static inline char *strrchr(const char *text, int c) {
    size_t n = strlen(text) + 1;
    while (n > 0 && text[n - 1] != (char)c) {
        n--;
    }
    return n ? (char *)(uintptr_t)(text + n - 1) : NULL;
}

static inline char *strstr(const char *text, const char *part) {
    size_t n = strlen(part);
    for (; *text; text++) {
        if (strncmp(text, part, n) == 0) {
            return (char *)(uintptr_t)text;
        }
    }
    return NULL;
}

/* ---- Numbers */

static inline double strtod(const char *text, char **end) {
    int length;
    double x = web_text_number(text, 0, &length);
    if (end) {
        *end = (char *)(uintptr_t)(text + length);
    }
    return x;
}

static inline float strtof(const char *text, char **end) {
    int length;
    float x = (float)web_text_number(text, 1, &length);
    if (end) {
        *end = (char *)(uintptr_t)(text + length);
    }
    return x;
}

static inline double ldexp(double x, int n) {
    const double step = n < 0 ? 0.5 : 2;
    for (; n != 0; n += n < 0 ? 1 : -1) {
        x *= step;
    }
    return x;
}

static inline double frexp(double x, int *exponent) {
    for (*exponent = 0; x != 0 && fabs(x) <= 1.7976931348623157e308 && fabs(x) >= 1; *exponent += 1) {
        x *= 0.5;
    }
    for (; x != 0 && fabs(x) < 0.5; *exponent -= 1) {
        x *= 2;
    }
    return x;
}

/* Of digits alone, as far as they go. */
static inline long strtol(const char *text, char **end, int base) {
    long x = 0;
    for (;; text++) {
        int digit = *text >= '0' && *text <= '9' ? *text - '0' : (*text | 32) >= 'a' && (*text | 32) <= 'z' ? (*text | 32) - 'a' + 10 : 99;
        if (digit >= base) {
            *end = (char *)(uintptr_t)text;
            return x;
        }
        x = base * x + digit;
    }
}

static inline int web_whole_text(uint64_t x, unsigned base, char *out) {
    char digits[24];
    int n = 0;
    int i;
    do {
        digits[n++] = "0123456789abcdef"[x % base];
        x /= base;
    } while (x);
    for (i = 0; i < n; i++) {
        out[i] = digits[n - 1 - i];
    }
    return n;
}

/* %d %u %lu %x %c %s %g %f %e %%, with a precision, and a width of blanks. */
static inline int vsnprintf(char *out, size_t room, const char *format, va_list args) {
    size_t used = 0;
    for (; *format; format++) {
        char text[400];
        const char *piece = text;
        int width = 0;
        int digits = -1;
        int longs = 0;
        size_t n = 0;
        size_t i;
        int64_t whole;
        if (*format != '%') {
            used + 1 < room ? (out[used] = *format) : 0;
            used++;
            continue;
        }
        for (format++; *format >= '0' && *format <= '9'; format++) {
            width = 10 * width + (*format - '0');
        }
        if (*format == '*') {
            width = va_arg(args, int);
            format++;
        }
        if (*format == '.' && format[1] == '*') {
            digits = va_arg(args, int);
            format += 2;
        } else if (*format == '.') {
            for (digits = 0, format++; *format >= '0' && *format <= '9'; format++) {
                digits = 10 * digits + (*format - '0');
            }
        }
        for (; *format == 'l' || *format == 'z'; format++) {
            longs++;
        }
        switch (*format) {
        case 'd':
            whole = longs > 1 ? va_arg(args, int64_t) : va_arg(args, int);
            text[0] = '-';
            n = (size_t)(whole < 0) + (size_t)web_whole_text(whole < 0 ? 0 - (uint64_t)whole : (uint64_t)whole, 10, text + (whole < 0));
            break;
        case 'u':
        case 'x':
            n = (size_t)web_whole_text(longs > 1 ? va_arg(args, uint64_t) : va_arg(args, unsigned), *format == 'x' ? 16 : 10, text);
            break;
        case 'c': text[0] = (char)va_arg(args, int); n = 1; break;
        case 's':
            piece = va_arg(args, const char *);
            for (n = 0; (digits < 0 || n < (size_t)digits) && piece[n]; n++) {
            }
            break;
        case 'g':
        case 'f':
        case 'e': n = (size_t)web_number_text(va_arg(args, double), *format, digits < 0 ? 6 : digits, text); break;
        default: text[0] = *format; n = 1; break;
        }
        for (i = 0; i < n || n < (size_t)width; i++) {
            char c = n < (size_t)width ? ' ' : piece[i];
            used + 1 < room ? (out[used] = c) : 0;
            used++;
            if (n < (size_t)width) {
                width--;
                i--;
            }
        }
    }
    if (room > 0) {
        out[used < room ? used : room - 1] = 0;
    }
    return (int)used;
}

static inline int snprintf(char *out, size_t room, const char *format, ...) {
    va_list args;
    int n;
    va_start(args, format);
    n = vsnprintf(out, room, format, args);
    va_end(args);
    return n;
}

/* ---- Files */

typedef struct FILE {
    unsigned char *bytes;
    size_t         size;
    size_t         room;
    int            failed;
} FILE;

static FILE web_file;                   /* the last one written */
static int errno;
#define stdin ((FILE *)0)
#define stdout (&web_file)
#define stderr ((FILE *)0)
#define SEEK_SET 0
#define SEEK_END 2

static inline FILE *fopen(const char *path, const char *mode) {
    (void)path;
    if (mode[0] != 'w') {
        return NULL;
    }
    web_file.size = 0;
    return &web_file;
}

static inline int fputc(int c, FILE *file) {
    if (file && file->size == file->room) {
        size_t room = file->room ? 2 * file->room : 65536;
        unsigned char *grown = (unsigned char *)realloc(file->bytes, room);
        file->failed |= !grown;
        file->bytes = grown ? grown : file->bytes;
        file->room = grown ? room : file->room;
    }
    if (!file || file->size == file->room) {
        return -1;
    }
    file->bytes[file->size++] = (unsigned char)c;
    return c;
}

static inline size_t fwrite(const void *bytes, size_t size, size_t count, FILE *file) {
    size_t i = 0;
    while (i < size * count && fputc(((const unsigned char *)bytes)[i], file) >= 0) {
        i++;
    }
    return size ? i / size : 0;
}

static inline int fputs(const char *text, FILE *file) {
    return fwrite(text, 1, strlen(text), file) == strlen(text) ? 0 : -1;
}

static inline int fprintf(FILE *file, const char *format, ...) {
    char line[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    return fputs(line, file);
}

static inline size_t fread(void *bytes, size_t size, size_t count, FILE *file) {
    (void)bytes;
    (void)size;
    (void)count;
    (void)file;
    return 0;
}

#define EOF (-1)
#define fgetc(file) ((void)(file), EOF)
#define putc fputc
#define printf(...) ((void)0)
#define fflush(file) 0
#define fclose(file) 0
#define ferror(file) ((file) && (file)->failed)
#define remove(path) 0
#define rename(from, to) 0
#define strerror(number) "the page reads one file at a time"

#endif /* WEB_LIBC_H */
