/* volume_headers.h - the readers of volume.h for .nrrd, .mha and .vti: a header of text, then numbers */
#ifndef EXAMPLES_VOLUME_HEADERS_H
#define EXAMPLES_VOLUME_HEADERS_H

/* ---- 6. NRRD and MetaImage ------------------------------------------------------------------------- */

/* The formats' names of types. */
static inline int volume_type_named(const char *name, volume_type *out) {
    static const struct {
        const char *name;
        volume_type type;
    } names[] = {
        {"signed char", {'i', 1}},
        {"int8", {'i', 1}},
        {"int8_t", {'i', 1}},
        {"MET_CHAR", {'i', 1}},
        {"Int8", {'i', 1}},
        {"uchar", {'u', 1}},
        {"unsigned char", {'u', 1}},
        {"uint8", {'u', 1}},
        {"uint8_t", {'u', 1}},
        {"MET_UCHAR", {'u', 1}},
        {"UInt8", {'u', 1}},
        {"short", {'i', 2}},
        {"int16", {'i', 2}},
        {"int16_t", {'i', 2}},
        {"MET_SHORT", {'i', 2}},
        {"Int16", {'i', 2}},
        {"ushort", {'u', 2}},
        {"unsigned short", {'u', 2}},
        {"uint16", {'u', 2}},
        {"uint16_t", {'u', 2}},
        {"MET_USHORT", {'u', 2}},
        {"UInt16", {'u', 2}},
        {"int", {'i', 4}},
        {"int32", {'i', 4}},
        {"int32_t", {'i', 4}},
        {"MET_INT", {'i', 4}},
        {"Int32", {'i', 4}},
        {"uint", {'u', 4}},
        {"unsigned int", {'u', 4}},
        {"uint32", {'u', 4}},
        {"uint32_t", {'u', 4}},
        {"MET_UINT", {'u', 4}},
        {"UInt32", {'u', 4}},
        {"longlong", {'i', 8}},
        {"long long", {'i', 8}},
        {"int64", {'i', 8}},
        {"int64_t", {'i', 8}},
        {"MET_LONG_LONG", {'i', 8}},
        {"Int64", {'i', 8}},
        {"ulonglong", {'u', 8}},
        {"unsigned long long", {'u', 8}},
        {"uint64", {'u', 8}},
        {"uint64_t", {'u', 8}},
        {"MET_ULONG_LONG", {'u', 8}},
        {"UInt64", {'u', 8}},
        {"float", {'f', 4}},
        {"MET_FLOAT", {'f', 4}},
        {"Float32", {'f', 4}},
        {"double", {'f', 8}},
        {"MET_DOUBLE", {'f', 8}},
        {"Float64", {'f', 8}},
        {"Bit", {'m', 0}},
    };
    size_t i;
    for (i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i].name, name) == 0) {
            *out = names[i].type;
            return 1;
        }
    }
    return 0;
}

/* A line of a header into `line`, cut to its room, without blanks at its end. Returns where the next begins,
   0 at the file's end. */
static inline size_t volume_line(const volume_file *f, size_t at, char *line, size_t room) {
    size_t used = 0;
    if (at >= f->size) {
        return 0;
    }
    for (; at < f->size && f->data[at] != '\n'; at++) {
        if (used + 1 < room) {
            line[used++] = (char)f->data[at];
        }
    }
    while (used > 0 && (line[used - 1] == '\r' || line[used - 1] == ' ')) {
        used -= 1;
    }
    line[used] = 0;
    return at + 1;
}

/* What stands behind "name<mark>" and blanks; NULL if the line is another. */
static inline const char *volume_field(const char *line, const char *name, char mark) {
    size_t length = strlen(name);
    if (strncmp(line, name, length) != 0) {
        return NULL;
    }
    for (line += length; *line == ' '; line++) {
    }
    if (*line != mark) {
        return NULL;
    }
    for (line++; *line == ' ' || *line == '='; line++) {
    }
    return line;
}

/* Three numbers, whatever parts them; the count found. */
static inline int volume_numbers(const char *text, double *out, int most) {
    int count = 0;
    while (count < most && *text) {
        char *end;
        out[count] = strtod(text, &end);
        if (end == text) {
            text += 1;
            continue;
        }
        text = end;
        count += 1;
    }
    return count;
}

/* Sides as they stand in a header. */
static inline int volume_sides(volume *v, const volume_file *f, const char *text) {
    double side[3];
    int a;
    if (volume_numbers(text, side, 3) != 3) {
        return volume_fail(f, "three sides expected");
    }
    for (a = 0; a < 3; a++) {
        v->n[a] = side[a] >= 1 && side[a] <= 1 << 20 ? (size_t)side[a] : 0;
    }
    return volume_check_sides(f, v->n);
}

/* Spacing from three vectors, which have to lie along the axes. */
static inline int volume_directions(volume *v, const volume_file *f, const char *text, int scale) {
    double m[9];
    int i;
    if (volume_numbers(text, m, 9) != 9) {
        return volume_fail(f, "nine numbers of directions expected");
    }
    for (i = 0; i < 9; i++) {
        if (i % 4 == 0 ? !(m[i] > 0) : !(fabs(m[i]) <= 0)) {
            return volume_fail(f, "axes that are turned or mirrored are not compared");
        }
        if (i % 4 == 0 && scale) {
            v->size[i / 4] = m[i];
        }
    }
    return 1;
}

/* What the header says beside the volume's own fields. */
typedef struct volume_header {
    char encoding[16];
    char file[512];             /* the numbers' own file, or "" */
    int  cells;
    long skip;                  /* bytes of that file; -1: the numbers are the file's last */
} volume_header;

static inline int volume_finish(volume *v, const volume_file *f, size_t at, const volume_header *h) {
    volume_file other;
    int compressed = strcmp(h->encoding, "raw") != 0;
    int ok;
    if (volume_count(v) == 0) {
        return volume_fail(f, "the header has no sizes");
    }
    if (v->type.kind == 0) {
        return volume_fail(f, "the header names no type of number that is known here");
    }
    if (h->file[0]) {
        if (!volume_open_beside(f, h->file, &other)) {
            return 0;
        }
        f = &other;
        at = 0;
    }
    if (h->skip < 0 && f->size >= volume_size(v->type, volume_count(v))) {
        at = f->size - volume_size(v->type, volume_count(v));
    } else if (h->skip > 0) {
        at += (size_t)h->skip;
    }
    ok = strcmp(h->encoding, "text") == 0 ? volume_take_text(v, f, at) : volume_take(v, f, at, compressed);
    if (h->file[0]) {
        free(other.data);
    }
    return ok;
}

static inline int nrrd_line(volume *v, const volume_file *f, const char *line, volume_header *h) {
    const char *text;
    if ((text = volume_field(line, "type", ':')) != NULL) {
        volume_type_named(text, &v->type);
    } else if ((text = volume_field(line, "dimension", ':')) != NULL) {
        return atoi(text) == 3 ? 1 : volume_fail(f, "three dimensions expected");
    } else if ((text = volume_field(line, "sizes", ':')) != NULL) {
        return volume_sides(v, f, text);
    } else if ((text = volume_field(line, "endian", ':')) != NULL) {
        v->big_endian = strcmp(text, "big") == 0;
    } else if ((text = volume_field(line, "encoding", ':')) != NULL) {
        snprintf(h->encoding, sizeof h->encoding, "%s",
                 strcmp(text, "gz") == 0                                  ? "gzip"
                 : strcmp(text, "txt") == 0 || strcmp(text, "ascii") == 0 ? "text"
                                                                          : text);
        if (strcmp(h->encoding, "raw") != 0 && strcmp(h->encoding, "gzip") != 0
            && strcmp(h->encoding, "text") != 0) {
            return volume_fail(f, "of the encodings raw, gzip and text are read");
        }
    } else if ((text = volume_field(line, "space directions", ':')) != NULL) {
        v->placed = VOLUME_SAMPLE;
        return volume_directions(v, f, text, 1);
    } else if ((text = volume_field(line, "spacings", ':')) != NULL) {
        v->placed = VOLUME_SAMPLE;
        return volume_numbers(text, v->size, 3) == 3 ? 1 : volume_fail(f, "three spacings expected");
    } else if ((text = volume_field(line, "space origin", ':')) != NULL
               || (text = volume_field(line, "axis mins", ':')) != NULL) {
        return volume_numbers(text, v->origin, 3) == 3
                   ? 1
                   : volume_fail(f, "three coordinates of the origin expected");
    } else if ((text = volume_field(line, "centerings", ':')) != NULL
               || (text = volume_field(line, "centers", ':')) != NULL) {
        h->cells = strncmp(text, "cell", 4) == 0;
    } else if ((text = volume_field(line, "byte skip", ':')) != NULL) {
        h->skip = atol(text);
    } else if ((text = volume_field(line, "data file", ':')) != NULL
               || (text = volume_field(line, "datafile", ':')) != NULL) {
        snprintf(h->file, sizeof h->file, "%s", text);
    }
    return 1;
}

/* The origin is the middle of the first sample. Where the header says that samples are cells, it is given as
   the corner of the first. */
static inline int nrrd_read(volume *v, const volume_file *f) {
    volume_header h;
    char line[1024] = "";
    size_t at = volume_line(f, 0, line, sizeof line);
    int a;
    memset(&h, 0, sizeof h);
    if (strncmp(line, "NRRD000", 7) != 0) {
        return volume_fail(f, "a .nrrd file begins with NRRD000");
    }
    for (at = volume_line(f, at, line, sizeof line); at && line[0];
         at = volume_line(f, at, line, sizeof line)) {
        if (line[0] != '#' && !nrrd_line(v, f, line, &h)) {
            return 0;
        }
    }
    v->format = "NRRD";
    volume_order(v, 1);
    for (a = 0; a < 3 && v->placed && h.cells; a++) {
        v->origin[a] -= 0.5 * v->size[a];
        v->placed = VOLUME_CORNER;
    }
    return volume_finish(v, f, at ? at : f->size, &h);
}

static inline int mha_line(volume *v, const volume_file *f, const char *line, volume_header *h) {
    const char *text;
    if ((text = volume_field(line, "NDims", '=')) != NULL) {
        return atoi(text) == 3 ? 1 : volume_fail(f, "three dimensions expected");
    }
    if ((text = volume_field(line, "DimSize", '=')) != NULL) {
        return volume_sides(v, f, text);
    }
    if ((text = volume_field(line, "ElementType", '=')) != NULL) {
        volume_type_named(text, &v->type);
    } else if ((text = volume_field(line, "ElementSpacing", '=')) != NULL
               || (text = volume_field(line, "ElementSize", '=')) != NULL) {
        v->placed = VOLUME_SAMPLE;
        return volume_numbers(text, v->size, 3) == 3 ? 1 : volume_fail(f, "three spacings expected");
    } else if ((text = volume_field(line, "Offset", '=')) != NULL
               || (text = volume_field(line, "Position", '=')) != NULL
               || (text = volume_field(line, "Origin", '=')) != NULL) {
        return volume_numbers(text, v->origin, 3) == 3
                   ? 1
                   : volume_fail(f, "three coordinates of the origin expected");
    } else if ((text = volume_field(line, "TransformMatrix", '=')) != NULL
               || (text = volume_field(line, "Rotation", '=')) != NULL) {
        return volume_directions(v, f, text, 0);
    } else if ((text = volume_field(line, "CompressedData", '=')) != NULL) {
        snprintf(h->encoding, sizeof h->encoding, "%s", text[0] == 'T' ? "zlib" : "raw");
    } else if ((text = volume_field(line, "BinaryDataByteOrderMSB", '=')) != NULL
               || (text = volume_field(line, "ElementByteOrderMSB", '=')) != NULL) {
        v->big_endian = text[0] == 'T';
    } else if ((text = volume_field(line, "BinaryData", '=')) != NULL && text[0] == 'F') {
        snprintf(h->encoding, sizeof h->encoding, "text");
    } else if ((text = volume_field(line, "HeaderSize", '=')) != NULL) {
        h->skip = atol(text);
    } else if ((text = volume_field(line, "ElementNumberOfChannels", '=')) != NULL) {
        return atoi(text) == 1 ? 1 : volume_fail(f, "one number for each voxel expected");
    }
    return 1;
}

/* ITK's and VTK's MetaImage: the origin is the middle of the first sample. */
static inline int mha_read(volume *v, const volume_file *f) {
    volume_header h;
    char line[1024] = "";
    const char *text = NULL;
    size_t at = 0;
    int a;
    memset(&h, 0, sizeof h);
    snprintf(h.encoding, sizeof h.encoding, "raw");
    for (a = 0; a < 3; a++) {
        v->size[a] = 1;
    }
    v->placed = VOLUME_SAMPLE;
    while (!text) {
        at = volume_line(f, at, line, sizeof line);
        if (!at) {
            return volume_fail(f, "a line 'ElementDataFile = ...' expected");
        }
        text = volume_field(line, "ElementDataFile", '=');
        if (!text && !mha_line(v, f, line, &h)) {
            return 0;
        }
    }
    if (strcmp(text, "LOCAL") != 0) {
        snprintf(h.file, sizeof h.file, "%s", text);
    }
    v->format = "MetaImage";
    volume_order(v, 1);
    return volume_finish(v, f, at < f->size ? at : f->size, &h);
}

/* ---- 7. VTK XML image data ------------------------------------------------------------------------- */

/* The value of an attribute of the tag at `tag`, into out. Returns 1, or 0 if the tag has none of that
   name. */
static inline int vti_attribute(const char *tag, const char *name, char *out, size_t room) {
    size_t length = strlen(name);
    size_t used = 0;
    const char *at;
    for (at = tag; *at && *at != '>'; at++) {
        if ((at[0] == ' ' || at[0] == '\n') && strncmp(at + 1, name, length) == 0 && at[1 + length] == '='
            && at[2 + length] == '"') {
            for (at += 3 + length; *at && *at != '"' && used + 1 < room; at++) {
                out[used++] = *at;
            }
            out[used] = 0;
            return 1;
        }
    }
    return 0;
}

/* The bytes of a text in base 64, as many as `room` holds; how many characters were used is added to *at. */
static inline size_t vti_base64(const volume_file *f, size_t *at, unsigned char *out, size_t room) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t held = 0;
    size_t used = 0;
    int count = 0;
    while (*at < f->size && used < room) {
        unsigned char c = f->data[*at];
        const char *digit = c ? strchr(digits, c) : NULL;
        if (c != ' ' && c != '\n' && c != '\r' && c != '\t' && c != '=' && !digit) {
            break;
        }
        *at += 1;
        if (!digit) {
            continue;
        }
        held = held << 6 | (uint32_t)(digit - digits);
        count += 1;
        if (count % 4 != 1) {
            int shift = count % 4 == 2 ? 4 : count % 4 == 3 ? 2 : 0;
            out[used++] = (unsigned char)(held >> shift);
            held &= ((uint32_t)1 << shift) - 1;
        }
    }
    while (count % 4 != 0 && *at < f->size && (f->data[*at] == '=' || strchr(digits, f->data[*at]))) {
        *at += 1;       /* to the end of the last group of four */
        count += 1;
    }
    return used;
}

/* Where the bytes of an array stand, and how. */
typedef struct vti_array {
    const volume_file *f;
    size_t             at;
    int                base64;
    int                word;            /* bytes of a length: 4 or 8 */
    int                big_endian;
    int                compressed;
} vti_array;

static inline size_t vti_bytes(vti_array *a, unsigned char *out, size_t count) {
    if (a->base64) {
        return vti_base64(a->f, &a->at, out, count);
    }
    if (count > a->f->size - a->at) {
        return 0;
    }
    memcpy(out, a->f->data + a->at, count);
    a->at += count;
    return count;
}

static inline uint64_t vti_length(const vti_array *a, const unsigned char *p) {
    volume_type type;
    double value;
    type.kind = 'u';
    type.bytes = a->word;
    value = volume_number(p, type, a->big_endian);
    return value < 1e15 ? (uint64_t)value : (uint64_t)1 << 50;
}

/* Blocks that are compressed each for itself: how many, their size, the last one's, then their compressed
   sizes. */
static inline int vti_blocks(vti_array *a, unsigned char *out, size_t bytes) {
    unsigned char head[24];
    size_t word = (size_t)a->word;
    vti_array sizes = *a;
    unsigned char *table = NULL;
    unsigned char *packed = NULL;
    uint64_t count;
    uint64_t block;
    uint64_t i;
    size_t done = 0;
    int ok;
    if (vti_bytes(&sizes, head, 3 * word) != 3 * word) {
        return 0;
    }
    count = vti_length(a, head);
    block = vti_length(a, head + word);
    if (count > a->f->size / word) {
        return 0;
    }
    table = (unsigned char *)malloc((3 + count) * word);
    packed = (unsigned char *)malloc(a->f->size);
    ok = table && packed && vti_bytes(a, table, (3 + count) * word) == (3 + count) * word;
    for (i = 0; ok && a->base64 && i < count; i++) {        /* in base 64 all blocks are one text: take it whole */
        done += (size_t)vti_length(a, table + (3 + i) * word);
        ok = done <= a->f->size;
    }
    ok = ok && (!a->base64 || vti_bytes(a, packed, done) == done);
    done = 0;
    sizes.at = 0;
    for (i = 0; ok && i < count; i++) {
        uint64_t size = vti_length(a, table + (3 + i) * word);
        uint64_t rest = vti_length(a, table + 2 * word);
        uint64_t now = i + 1 == count && rest ? rest : block;
        const unsigned char *from = a->base64 ? packed + sizes.at : a->f->data + a->at + sizes.at;
        ok = size <= (a->base64 ? a->f->size : a->f->size - a->at) - sizes.at && now <= bytes - done
             && inflate_all(from, (size_t)size, out + done, (size_t)now);
        sizes.at += (size_t)size;
        done += (size_t)now;
    }
    free(table);
    free(packed);
    return ok && done == bytes;
}

static inline int vti_take(volume *v, vti_array *a) {
    unsigned char length[8];
    size_t bytes = volume_size(v->type, volume_count(v));
    int ok;
    if (bytes / 1040 > a->f->size) {
        return volume_fail(a->f, "the file is too short for the voxels that it promises");
    }
    v->bytes = (unsigned char *)malloc(bytes);
    if (!v->bytes) {
        return volume_fail(a->f, "out of memory");
    }
    if (a->compressed) {
        ok = vti_blocks(a, v->bytes, bytes);
    } else if (a->base64) {         /* length and numbers are one text */
        unsigned char *both = (unsigned char *)malloc(bytes + (size_t)a->word);
        ok = both && vti_bytes(a, both, bytes + (size_t)a->word) == bytes + (size_t)a->word
             && vti_length(a, both) == bytes;
        if (ok) {
            memcpy(v->bytes, both + a->word, bytes);
        }
        free(both);
    } else {
        ok = vti_bytes(a, length, (size_t)a->word) == (size_t)a->word && vti_length(a, length) == bytes
             && vti_bytes(a, v->bytes, bytes) == bytes;
    }
    return ok ? 1 : volume_fail(a->f, "the numbers are damaged, or not as many as promised");
}

/* Sides and place: points or cells of the extent. */
static inline int vti_place(volume *v, const volume_file *f, const char *image, int cells) {
    char text[512];
    double extent[6];
    int a;
    if (!vti_attribute(image, "WholeExtent", text, sizeof text) || volume_numbers(text, extent, 6) != 6) {
        return volume_fail(f, "the image has no WholeExtent of six numbers");
    }
    for (a = 0; a < 3; a++) {
        double side = extent[2 * a + 1] - extent[2 * a] + (cells ? 0 : 1);
        v->n[a] = side >= 1 && side <= 1 << 20 ? (size_t)side : 0;
        v->size[a] = 1;
    }
    if (vti_attribute(image, "Direction", text, sizeof text) && !volume_directions(v, f, text, 0)) {
        return 0;
    }
    if ((vti_attribute(image, "Spacing", text, sizeof text) && volume_numbers(text, v->size, 3) != 3)
        || (vti_attribute(image, "Origin", text, sizeof text) && volume_numbers(text, v->origin, 3) != 3)) {
        return volume_fail(f, "three numbers of origin and spacing expected");
    }
    for (a = 0; a < 3; a++) {
        v->origin[a] += extent[2 * a] * v->size[a];
    }
    v->placed = cells ? VOLUME_CORNER : VOLUME_SAMPLE;
    return volume_check_sides(f, v->n);
}

/* The array that the tag names as its Scalars, or the first. */
static inline const char *vti_find_array(const char *data) {
    char wanted[128] = "";
    char name[128] = "";
    const char *first = strstr(data, "<DataArray");
    const char *array;
    vti_attribute(data, "Scalars", wanted, sizeof wanted);
    for (array = first; array; array = strstr(array + 1, "<DataArray")) {
        if (wanted[0] && vti_attribute(array, "Name", name, sizeof name) && strcmp(name, wanted) == 0) {
            return array;
        }
    }
    return first;
}

static inline int vti_read(volume *v, const volume_file *f) {
    const char *text = (const char *)f->data;
    const char *file = strstr(text, "<VTKFile");
    const char *image = file ? strstr(file, "<ImageData") : NULL;
    const char *piece = image ? strstr(image, "<Piece") : NULL;
    const char *points = piece ? strstr(piece, "<PointData") : NULL;
    const char *cells = piece ? strstr(piece, "<CellData") : NULL;
    const char *end_of_points = points ? strstr(points, "</PointData") : NULL;
    const char *array = points && end_of_points ? vti_find_array(points) : NULL;
    int in_cells = !array || array > end_of_points;
    char value[128] = "";
    vti_array a;
    memset(&a, 0, sizeof a);
    a.f = f;
    array = in_cells && cells ? vti_find_array(cells) : array;
    if (!array) {
        return volume_fail(f, "a VTKFile with ImageData, a Piece and a DataArray expected");
    }
    if (piece && strstr(piece + 1, "<Piece")) {
        return volume_fail(f, "an image in one piece expected");
    }
    v->format = "VTK image data";
    if (!vti_place(v, f, image, in_cells)) {
        return 0;
    }
    if (!vti_attribute(array, "type", value, sizeof value) || !volume_type_named(value, &v->type)
        || (vti_attribute(array, "NumberOfComponents", value, sizeof value) && atoi(value) != 1)) {
        return volume_fail(f, "an array of one number for each voxel expected");
    }
    volume_order(v, 1);
    a.big_endian = v->big_endian = vti_attribute(file, "byte_order", value, sizeof value) && value[0] == 'B';
    a.word = vti_attribute(file, "header_type", value, sizeof value) && strcmp(value, "UInt64") == 0 ? 8 : 4;
    a.compressed = vti_attribute(file, "compressor", value, sizeof value);
    if (a.compressed && strcmp(value, "vtkZLibDataCompressor") != 0) {
        return volume_fail(f, "of VTK's compressors zlib is read");
    }
    a.at = (size_t)(strchr(array, '>') ? strchr(array, '>') + 1 - text : 0);
    a.base64 = 1;
    if (!vti_attribute(array, "format", value, sizeof value) || strcmp(value, "ascii") == 0) {
        return volume_take_text(v, f, a.at);
    }
    if (strcmp(value, "appended") == 0) {
        const char *appended = strstr(array, "<AppendedData");
        size_t offset = vti_attribute(array, "offset", value, sizeof value) ? strtoul(value, NULL, 10) : 0;
        if (!appended || !strchr(appended, '_')) {
            return volume_fail(f, "the appended data are missing");
        }
        a.base64 = vti_attribute(appended, "encoding", value, sizeof value) && strcmp(value, "base64") == 0;
        a.at = (size_t)(strchr(appended, '_') + 1 - text);
        a.at += offset < f->size - a.at ? offset : f->size - a.at;
    }
    return vti_take(v, &a);
}

#endif /* EXAMPLES_VOLUME_HEADERS_H */
