/* png.h - writes an 8-bit RGB picture as PNG, with a small deflate of its own (fixed Huffman codes, hashed
 * matches)
 *
 * Sources: the PNG specification (W3C, second edition) for chunks and filters, RFC 1950 and RFC 1951 for
 * the stream.
 */
#ifndef EXAMPLES_PNG_H
#define EXAMPLES_PNG_H
#include "voxel_io.h"

typedef struct png_stream {
    unsigned char *bytes;
    size_t         size;
    size_t         room;
    uint32_t       hold;            /* bits not yet written, from the lowest */
    int            held;
    int            failed;          /* memory was short */
} png_stream;

static inline void png_byte(png_stream *s, unsigned value) {
    if (s->size == s->room) {
        size_t room = s->room ? 2 * s->room : 65536;
        void *grown = s->failed ? NULL : realloc(s->bytes, room);
        if (!grown) {
            s->failed = 1;
            return;
        }
        s->bytes = (unsigned char *)grown;
        s->room = room;
    }
    s->bytes[s->size] = (unsigned char)value;
    s->size += 1;
}

static inline void png_bits(png_stream *s, unsigned value, int count) {
    s->hold |= (uint32_t)value << s->held;
    s->held += count;
    for (; s->held >= 8; s->held -= 8) {
        png_byte(s, s->hold & 255);
        s->hold >>= 8;
    }
}

/* Huffman codes, of nine bits at most, enter with their highest bit first: turned round by halves of a byte. */
static inline void png_code(png_stream *s, unsigned code, int count) {
    static const unsigned char turned[16] = {0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};
    unsigned wide = code << (12 - count);
    png_bits(s, (unsigned)turned[wide >> 8 & 15] | (unsigned)turned[wide >> 4 & 15] << 4 | (unsigned)turned[wide & 15] << 8,
             count);
}

/* A literal or length symbol in the fixed code of RFC 1951, 3.2.6. */
static inline void png_symbol(png_stream *s, unsigned symbol) {
    if (symbol < 144) {
        png_code(s, 0x30 + symbol, 8);
    } else if (symbol < 256) {
        png_code(s, 0x190 + symbol - 144, 9);
    } else if (symbol < 280) {
        png_code(s, symbol - 256, 7);
    } else {
        png_code(s, 0xc0 + symbol - 280, 8);
    }
}

/* Splits a length (from 3) or distance (from 1) into its symbol and extra bits: the classes double every
   `per` symbols (4 for lengths, 2 for distances) once the first 2 * per symbols have none. */
static inline unsigned png_class(unsigned offset, unsigned per, int *out_extra_bits, unsigned *out_extra) {
    int extra = 0;
    while (offset >> extra >= 2 * per) {
        extra += 1;
    }
    *out_extra_bits = extra;
    *out_extra = offset & ((1u << extra) - 1);
    return per * (unsigned)extra + (offset >> extra);
}

static inline void png_match(png_stream *s, unsigned length, unsigned distance) {
    int bits;
    unsigned extra;
    unsigned symbol;
    if (length == 258) {        /* has a symbol of its own */
        png_symbol(s, 285);
    } else {
        symbol = png_class(length - 3, 4, &bits, &extra);
        png_symbol(s, 257 + symbol);
        png_bits(s, extra, bits);
    }
    symbol = png_class(distance - 1, 2, &bits, &extra);
    png_code(s, symbol, 5);
    png_bits(s, extra, bits);
}

enum { PNG_HASHES = 1 << 15, PNG_WINDOW = 32768, PNG_TRIES = 4 };

typedef struct png_matcher {
    /* latest place of each hash, then the place before each place in the window; -1: none */
    int32_t *head;
    int32_t *before;
} png_matcher;

static inline size_t png_hash(const unsigned char *p) {
    uint32_t word = (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
    return word * 2654435761u >> 17;
}

static inline void png_remember(png_matcher *m, const unsigned char *data, size_t at) {
    size_t hash = png_hash(data + at);
    m->before[at % PNG_WINDOW] = m->head[hash];
    m->head[hash] = (int32_t)at;
}

/* The longest of a few earlier strings that continue like this one; 0 if none has 3 bytes. */
static inline unsigned png_longest(const png_matcher *m, const unsigned char *data, size_t size, size_t at,
                                   size_t *out_distance) {
    size_t limit = size - at < 258 ? size - at : 258;
    size_t best = 2;
    int32_t earlier = m->head[png_hash(data + at)];
    int tries;
    for (tries = 0; tries < PNG_TRIES && earlier >= 0 && at - (size_t)earlier <= PNG_WINDOW - 1; tries++) {
        size_t length = 0;
        while (length < limit && data[(size_t)earlier + length] == data[at + length]) {
            length += 1;
        }
        if (length > best) {
            best = length;
            *out_distance = at - (size_t)earlier;
        }
        earlier = m->before[(size_t)earlier % PNG_WINDOW];
    }
    return best > 2 ? (unsigned)best : 0;
}

/* The zlib stream of the data, in one block. */
static inline void png_deflate(png_stream *s, const unsigned char *data, size_t size) {
    png_matcher m;
    uint32_t low = 1;
    uint32_t high = 0;
    size_t i;
    size_t at = 0;
    m.head = (int32_t *)malloc((PNG_HASHES + PNG_WINDOW) * sizeof *m.head);
    if (!m.head) {
        s->failed = 1;
        return;
    }
    memset(m.head, 0xff, (PNG_HASHES + PNG_WINDOW) * sizeof *m.head);
    m.before = m.head + PNG_HASHES;
    png_byte(s, 0x78);
    png_byte(s, 0x01);
    png_bits(s, 1, 1);          /* the last block, with fixed codes */
    png_bits(s, 1, 2);
    while (at < size) {
        size_t distance = 0;
        unsigned length = size - at >= 3 ? png_longest(&m, data, size, at, &distance) : 0;
        if (length) {
            png_match(s, length, (unsigned)distance);
        } else {
            png_symbol(s, data[at]);
        }
        for (i = 0; i < (length ? length : 1); i++, at++) {
            if (size - at >= 3) {
                png_remember(&m, data, at);
            }
        }
    }
    png_symbol(s, 256);
    png_bits(s, 0, 7);          /* fills the last byte */
    for (i = 0; i < size; i++) {
        low += data[i];
        high += low;
        if (i % 4096 == 4095 || i + 1 == size) {        /* the sums of 4096 bytes fit in 32 bits */
            low %= 65521;
            high %= 65521;
        }
    }
    for (i = 0; i < 4; i++) {
        png_byte(s, (high << 16 | low) >> (24 - 8 * i) & 255);
    }
    free(m.head);
}

static inline void png_put_u32(FILE *file, uint32_t value) {
    int i;
    for (i = 24; i >= 0; i -= 8) {
        fputc((int)(value >> i & 255), file);
    }
}

static inline uint32_t png_crc(uint32_t crc, const unsigned char *bytes, size_t size) {
    uint32_t of_byte[256];
    size_t i;
    int k;
    for (i = 0; i < 256; i++) {
        of_byte[i] = (uint32_t)i;
        for (k = 0; k < 8; k++) {
            of_byte[i] = of_byte[i] >> 1 ^ (of_byte[i] & 1 ? 0xedb88320u : 0);
        }
    }
    for (i = 0; i < size; i++) {
        crc = crc >> 8 ^ of_byte[(crc ^ bytes[i]) & 255];
    }
    return crc;
}

static inline void png_chunk(FILE *file, const char *name, const unsigned char *bytes, size_t size) {
    uint32_t crc = png_crc(0xffffffffu, (const unsigned char *)name, 4);
    png_put_u32(file, (uint32_t)size);
    fwrite(name, 1, 4, file);
    if (size > 0) {
        fwrite(bytes, 1, size, file);
        crc = png_crc(crc, bytes, size);
    }
    png_put_u32(file, ~crc);
}

/* Filter 4, Paeth: each byte less the neighbour, left, above or above left, nearest to left + above -
   above left. */
static inline void png_filter_row(const unsigned char *row, const unsigned char *above, size_t size,
                                  unsigned char *out) {
    size_t i;
    out[0] = 4;
    for (i = 0; i < size; i++) {
        int a = i < 3 ? 0 : row[i - 3];
        int b = above ? above[i] : 0;
        int c = i < 3 || !above ? 0 : above[i - 3];
        int pa = abs(b - c);
        int pb = abs(a - c);
        int pc = abs(a + b - 2 * c);
        int guess = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
        out[1 + i] = (unsigned char)(row[i] - guess);
    }
}

/* Writes width * height pixels of red, green, blue, from the top left. Returns 1, or 0 with a sentence in
   `error`. */
static inline int png_write(const char *path, const unsigned char *pixels, size_t width, size_t height,
                            char *error) {
    unsigned char header[13] = {0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0};       /* 8 bits, RGB */
    unsigned char *rows = (unsigned char *)malloc((3 * width + 1) * height);
    png_stream s = {NULL, 0, 0, 0, 0, 0};
    FILE *file;
    size_t y;
    int i;
    if (rows) {
        for (y = 0; y < height; y++) {
            png_filter_row(pixels + 3 * width * y, y ? pixels + 3 * width * (y - 1) : NULL, 3 * width,
                           rows + (3 * width + 1) * y);
        }
        png_deflate(&s, rows, (3 * width + 1) * height);
    }
    free(rows);
    file = rows && !s.failed ? voxels_create(path, error) : NULL;
    if (!file) {
        free(s.bytes);
        return rows && !s.failed ? 0 : voxels_fail(path, "out of memory", error);
    }
    for (i = 0; i < 4; i++) {
        header[i] = (unsigned char)(width >> (24 - 8 * i) & 255);
        header[4 + i] = (unsigned char)(height >> (24 - 8 * i) & 255);
    }
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
    png_chunk(file, "IHDR", header, sizeof header);
    png_chunk(file, "IDAT", s.bytes, s.size);
    png_chunk(file, "IEND", NULL, 0);
    free(s.bytes);
    return voxels_close(file, path, error);
}

#endif /* EXAMPLES_PNG_H */
