/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Scanning a file in memory. The zero behind its last byte ends every number, so strtod and its
 * kin cannot run past it.
 */
#include "base/scan.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct kr_scan kr_scan_open(const char *path) {
    struct kr_scan scan = {.path = path};
    struct stat about;
    FILE *file = fopen(path, "rb");
    if (!file || fstat(fileno(file), &about))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    if (!S_ISREG(about.st_mode))
        kr_stop(KR_EXIT_INPUT, "%s is no file", path);
    scan.size = (size_t)about.st_size;
    scan.data = KR_NEW_RAW(char, scan.size + 1);
    scan.data[scan.size] = 0;
    if (fread(scan.data, 1, scan.size, file) != scan.size)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    fclose(file);
    return scan;
}

void kr_scan_close(struct kr_scan *scan) {
    scan->data = kr_free(scan->data);
}

void kr_scan_bad(const struct kr_scan *scan, const char *format, ...) {
    char sentence[512];
    size_t line = 1;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    if (scan->is_binary)
        kr_stop(KR_EXIT_INPUT, "%s, byte %zu: %s", scan->path, scan->at, sentence);
    for (size_t k = 0; k < scan->at && k < scan->size; k++)
        line += scan->data[k] == '\n';
    kr_stop(KR_EXIT_INPUT, "%s:%zu: %s", scan->path, line, sentence);
}

static void skip_blank(struct kr_scan *scan) {
    if (scan->at >= scan->size)
        return;
    const char *at = scan->data + scan->at; /* the zero at the end is no blank */
    while (*at == ' ' || (*at >= '\t' && *at <= '\r'))
        at++;
    scan->at = (size_t)(at - scan->data);
}

/** Take `bytes` of a binary number. */
static void take(struct kr_scan *scan, void *into, size_t bytes, const char *what) {
    if (scan->size - scan->at < bytes)
        kr_scan_bad(scan, "the file ends before %s", what);
    memcpy(into, scan->data + scan->at, bytes);
    scan->at += bytes;
}

/** Stop because the text here is no number of the kind wanted. */
_Noreturn static void no_number(struct kr_scan *scan, const char *what) {
    int length = 0;
    if (scan->at >= scan->size)
        kr_scan_bad(scan, "the file ends before %s", what);
    while (length < 40 && isgraph((unsigned char)scan->data[scan->at + (size_t)length]))
        length++;
    kr_scan_bad(scan, "expected %s, found '%.*s'", what, length, scan->data + scan->at);
}

/** Whether a number ended well at `end`: something was read, and white space follows. */
static int ended_well(const struct kr_scan *scan, const char *end) {
    const char *begin = scan->data + scan->at;
    return end > begin && end <= scan->data + scan->size &&
           (end == scan->data + scan->size || isspace((unsigned char)*end));
}

/** A plain number of up to 18 digits, nearly all there are; 0 for any other text. */
static int short_integer(struct kr_scan *scan, long long *value) {
    const char *begin = scan->data + scan->at, *at = begin;
    unsigned long long sum = 0;
    for (unsigned digit; (digit = (unsigned)*at - '0') < 10; at++)
        sum = 10 * sum + digit;
    if (at == begin || at - begin > 18 || (*at != ' ' && *at != '\n'))
        return 0;
    *value = (long long)sum;
    scan->at += (size_t)(at - begin);
    return 1;
}

static long long text_integer(struct kr_scan *scan, const char *what) {
    char *end;
    long long plain;
    skip_blank(scan);
    if (short_integer(scan, &plain))
        return plain;
    errno = 0;
    long long value = strtoll(scan->data + scan->at, &end, 10);
    if (errno || !ended_well(scan, end))
        no_number(scan, what);
    scan->at = (size_t)(end - scan->data);
    return value;
}

int kr_scan_int(struct kr_scan *scan, const char *what) {
    int value;
    if (scan->is_binary) {
        take(scan, &value, sizeof value, what);
        return value;
    }
    long long wide = text_integer(scan, what);
    if (wide < INT_MIN || wide > INT_MAX)
        kr_scan_bad(scan, "%lld is too large for %s", wide, what);
    return (int)wide;
}

size_t kr_scan_size(struct kr_scan *scan, const char *what) {
    int64_t value;
    if (scan->is_binary)
        take(scan, &value, sizeof value, what);
    else
        value = text_integer(scan, what);
    if (value < 0)
        kr_scan_bad(scan, "%s is negative: %lld", what, (long long)value);
    return (size_t)value;
}

/** A plain decimal number whose digits are an integer below 2^53 and whose power of ten is below 10^23: both are exact
 *  in double precision, so one multiplication or division rounds as strtod does (Clinger, "How to read floating
 *  point numbers accurately", 1990). 0 for any other text. */
static int short_double(struct kr_scan *scan, double *value) {
    static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const char *at = scan->data + scan->at + (scan->data[scan->at] == '-'), *begin = at, *point = NULL;
    unsigned long long sum = 0;
    int digits = 0, exponent = 0;
    for (unsigned digit; (digit = (unsigned)*at - '0') < 10 || (*at == '.' && !point); at++) {
        if (digit < 10) {
            sum = 10 * sum + digit;
            digits += sum > 0;
        } else {
            point = at;
        }
    }
    if (at - begin - (point != NULL) < 1 || digits > 18 || sum >> 53)
        return 0;
    const long decimals = point ? at - point - 1 : 0;
    if (*at == 'e') {
        const int sign = at[1] == '-' ? -1 : 1;
        at += 1 + (at[1] == '-' || at[1] == '+');
        if ((unsigned)at[0] - '0' > 9 || (unsigned)at[1] - '0' > 9)
            return 0;
        exponent = sign * (10 * (at[0] - '0') + (at[1] - '0'));
        at += 2;
    }
    const long ten = exponent - decimals;
    if ((*at != ' ' && *at != '\n') || ten < -22 || ten > 22)
        return 0;
    *value = ten < 0 ? (double)sum / power[-ten] : (double)sum * power[ten];
    *value = scan->data[scan->at] == '-' ? -*value : *value;
    scan->at = (size_t)(at - scan->data);
    return 1;
}

static double text_double(struct kr_scan *scan, const char *what) {
    char *end;
    double value;
    skip_blank(scan);
    if (short_double(scan, &value))
        return value;
    value = strtod(scan->data + scan->at, &end);
    if (!ended_well(scan, end))
        no_number(scan, what);
    scan->at = (size_t)(end - scan->data);
    return value;
}

double kr_scan_double(struct kr_scan *scan, const char *what) {
    double value;
    if (scan->is_binary)
        take(scan, &value, sizeof value, what);
    else
        value = text_double(scan, what);
    if (!isfinite(value))
        kr_scan_bad(scan, "%s is not finite", what);
    return value;
}

void kr_scan_sizes(struct kr_scan *scan, size_t n, size_t *value, const char *what) {
    size_t all = 0;
    if (scan->is_binary && n <= (scan->size - scan->at) / sizeof *value) {
        memcpy(value, scan->data + scan->at, n * sizeof *value);
        for (size_t k = 0; k < n; k++)
            all |= value[k];
        if (all <= INT64_MAX) { /* none is negative */
            scan->at += n * sizeof *value;
            return;
        }
    }
    for (size_t k = 0; k < n; k++)
        value[k] = kr_scan_size(scan, what);
}

void kr_scan_doubles(struct kr_scan *scan, size_t n, double *value, const char *what) {
    int are_finite = 1;
    if (scan->is_binary && n <= (scan->size - scan->at) / sizeof *value) {
        memcpy(value, scan->data + scan->at, n * sizeof *value);
        for (size_t k = 0; k < n; k++)
            are_finite &= value[k] - value[k] == 0;
        if (are_finite) {
            scan->at += n * sizeof *value;
            return;
        }
    }
    for (size_t k = 0; k < n; k++)
        value[k] = kr_scan_double(scan, what);
}

size_t kr_scan_count(struct kr_scan *scan, size_t least, const char *what) {
    size_t count = kr_scan_size(scan, what);
    /* A number takes 4 bytes or more in binary, and in ASCII a digit and a blank. */
    size_t bytes = (scan->is_binary ? 4 : 2) * least;
    if (count > (scan->size - scan->at + 1) / bytes)
        kr_scan_bad(scan,
                    "%s is %zu, more than the rest of the file can hold: it is cut or garbled",
                    what, count);
    return count;
}

int kr_scan_word(struct kr_scan *scan, char *word, size_t room) {
    size_t length = 0;
    skip_blank(scan);
    while (scan->at < scan->size && !isspace((unsigned char)scan->data[scan->at])) {
        if (length + 1 < room)
            word[length++] = scan->data[scan->at];
        scan->at++;
    }
    word[length] = 0;
    return length > 0;
}

void kr_scan_expect(struct kr_scan *scan, const char *word) {
    char found[64];
    size_t from = scan->at;
    if (!kr_scan_word(scan, found, sizeof found)) {
        kr_scan_bad(scan, "the file ends before %s", word);
    } else if (strcmp(found, word)) {
        for (char *c = found; *c; c++)
            if (!isgraph((unsigned char)*c))
                *c = '?';
        scan->at = from;
        skip_blank(scan);
        kr_scan_bad(scan, "expected %s, found '%.40s'", word, found);
    }
}
