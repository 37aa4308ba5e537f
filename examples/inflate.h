/* inflate.h - undoes the compression of zlib, gzip and bare deflate streams (RFC 1950, 1952, 1951)
 *
 * Volumes come compressed: VTK's .vti by default, .nrrd with "encoding: gzip", .mha with "CompressedData =
 * True". A damaged stream gives 0 and never more output than there is room for. Checksums are not compared.
 */
#ifndef EXAMPLES_INFLATE_H
#define EXAMPLES_INFLATE_H
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct inflate {
    const unsigned char *in;
    size_t               in_size;
    size_t               in_at;
    uint32_t             held;          /* bits read and not yet used, the next one lowest */
    int                  held_count;
    unsigned char       *out;
    size_t               room;
    size_t               used;
    int                  bad;
} inflate;

/* A canonical code: count[n] codes have n bits; symbol[] lists them in the order of their codes. */
typedef struct inflate_code {
    uint16_t count[16];
    uint16_t symbol[288];
} inflate_code;

static inline uint32_t inflate_bits(inflate *s, int count) {
    uint32_t value;
    while (s->held_count < count) {
        if (s->in_at >= s->in_size) {
            s->bad = 1;
            return 0;
        }
        s->held |= (uint32_t)s->in[s->in_at++] << s->held_count;
        s->held_count += 8;
    }
    value = s->held & (((uint32_t)1 << count) - 1);
    s->held >>= count;
    s->held_count -= count;
    return value;
}

static inline void inflate_make_code(inflate_code *code, const unsigned char *length, int symbols) {
    uint16_t place[16];
    int i;
    memset(code->count, 0, sizeof code->count);
    for (i = 0; i < symbols; i++) {
        code->count[length[i]]++;
    }
    code->count[0] = 0;
    place[1] = 0;
    for (i = 1; i < 15; i++) {
        place[i + 1] = (uint16_t)(place[i] + code->count[i]);
    }
    for (i = 0; i < symbols; i++) {
        if (length[i]) {
            code->symbol[place[length[i]]++] = (uint16_t)i;
        }
    }
}

/* Reads a code bit by bit: of n bits, the first of them is `first`, and there are count[n]. */
static inline int inflate_symbol(inflate *s, const inflate_code *code) {
    int value = 0;
    int first = 0;
    int index = 0;
    int bits;
    for (bits = 1; bits < 16 && !s->bad; bits++) {
        value |= (int)inflate_bits(s, 1);
        if (value >= first && value - first < code->count[bits]) {
            return code->symbol[index + value - first];
        }
        index += code->count[bits];
        first = (first + code->count[bits]) << 1;
        value <<= 1;
    }
    s->bad = 1;
    return 256;
}

static inline void inflate_byte(inflate *s, unsigned char byte) {
    if (s->used >= s->room) {
        s->bad = 1;
        return;
    }
    s->out[s->used++] = byte;
}

/* Repeats what stands `back` bytes before. */
static inline void inflate_repeat(inflate *s, size_t length, size_t back) {
    if (back > s->used) {
        s->bad = 1;
    }
    for (; length > 0 && !s->bad; length--) {
        inflate_byte(s, s->out[s->used - back]);
    }
}

static inline void inflate_block(inflate *s, const inflate_code *literals, const inflate_code *distances) {
    static const uint16_t length_base[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                             31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const uint16_t back_base[30] = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                           33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                           1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    while (!s->bad) {
        int symbol = inflate_symbol(s, literals);
        size_t length;
        if (symbol == 256) {
            return;
        }
        if (symbol < 256) {
            inflate_byte(s, (unsigned char)symbol);
            continue;
        }
        symbol -= 257;
        if (symbol >= 29) {
            s->bad = 1;
            return;
        }
        length = length_base[symbol] + inflate_bits(s, symbol < 8 || symbol == 28 ? 0 : symbol / 4 - 1);
        symbol = inflate_symbol(s, distances);
        if (symbol >= 30) {
            s->bad = 1;
            return;
        }
        inflate_repeat(s, length, back_base[symbol] + inflate_bits(s, symbol < 4 ? 0 : symbol / 2 - 1));
    }
}

/* The codes that a dynamic block brings along, themselves coded. */
static inline void inflate_read_codes(inflate *s, inflate_code *literals, inflate_code *distances) {
    static const unsigned char order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    unsigned char length[320] = {0};
    inflate_code lengths;
    int literal_count = 257 + (int)inflate_bits(s, 5);
    int distance_count = 1 + (int)inflate_bits(s, 5);
    int count = 4 + (int)inflate_bits(s, 4);
    int i;
    for (i = 0; i < count; i++) {
        length[order[i]] = (unsigned char)inflate_bits(s, 3);
    }
    inflate_make_code(&lengths, length, 19);
    memset(length, 0, sizeof length);
    for (i = 0; i < literal_count + distance_count && !s->bad;) {
        int symbol = inflate_symbol(s, &lengths);
        int repeat = symbol < 16 ? 1 : symbol == 16 ? 3 + (int)inflate_bits(s, 2)
                   : symbol == 17 ? 3 + (int)inflate_bits(s, 3) : 11 + (int)inflate_bits(s, 7);
        int value = symbol < 16 ? symbol : symbol == 16 && i > 0 ? length[i - 1] : 0;
        if (i + repeat > literal_count + distance_count || symbol > 18) {
            s->bad = 1;
            return;
        }
        for (; repeat > 0; repeat--) {
            length[i++] = (unsigned char)value;
        }
    }
    inflate_make_code(literals, length, literal_count < 288 ? literal_count : 288);
    inflate_make_code(distances, length + literal_count, distance_count);
}

static inline void inflate_fixed_codes(inflate_code *literals, inflate_code *distances) {
    unsigned char length[288];
    memset(length, 8, 144);
    memset(length + 144, 9, 112);
    memset(length + 256, 7, 24);
    memset(length + 280, 8, 8);
    inflate_make_code(literals, length, 288);
    memset(length, 5, 30);
    inflate_make_code(distances, length, 30);
}

static inline void inflate_stored(inflate *s) {
    size_t length;
    s->held = 0;
    s->held_count = 0;
    if (s->in_size - s->in_at < 4) {
        s->bad = 1;
        return;
    }
    length = (size_t)s->in[s->in_at] | (size_t)s->in[s->in_at + 1] << 8;
    s->in_at += 4;
    for (; length > 0 && !s->bad; length--) {
        inflate_byte(s, (unsigned char)inflate_bits(s, 8));
    }
}

/* The bytes before the deflate stream: a zlib or a gzip header, or none. */
static inline size_t inflate_header(const unsigned char *in, size_t size) {
    size_t at = 10;
    if (size >= 2 && (in[0] & 15) == 8 && (in[0] * 256 + in[1]) % 31 == 0) {
        return 2;
    }
    if (size < 18 || in[0] != 0x1f || in[1] != 0x8b) {
        return 0;
    }
    if (in[3] & 4) {
        at += 2 + (size_t)in[10] + 256 * (size_t)in[11];
    }
    if (in[3] & 8) {        /* the file's name, and a comment, each to a zero */
        while (at < size && in[at++]) {
        }
    }
    if (in[3] & 16) {
        while (at < size && in[at++]) {
        }
    }
    return at + (in[3] & 2 ? 2 : 0);
}

/* Fills out[0..room), which the stream must fill exactly. Returns 1, or 0 if it does not, or is damaged. */
static inline int inflate_all(const unsigned char *in, size_t in_size, unsigned char *out, size_t room) {
    inflate_code literals;
    inflate_code distances;
    inflate s;
    int last = 0;
    memset(&s, 0, sizeof s);
    s.in = in;
    s.in_size = in_size;
    s.in_at = inflate_header(in, in_size);
    s.in_at = s.in_at < in_size ? s.in_at : in_size;        /* a header that promises more than there is */
    s.out = out;
    s.room = room;
    while (!last && !s.bad) {
        int kind;
        last = (int)inflate_bits(&s, 1);
        kind = (int)inflate_bits(&s, 2);
        if (kind == 0) {
            inflate_stored(&s);
            continue;
        }
        if (kind == 1) {
            inflate_fixed_codes(&literals, &distances);
        } else if (kind == 2) {
            inflate_read_codes(&s, &literals, &distances);
        } else {
            s.bad = 1;
        }
        if (!s.bad) {
            inflate_block(&s, &literals, &distances);
        }
    }
    return !s.bad && s.used == room;
}

#endif /* EXAMPLES_INFLATE_H */
