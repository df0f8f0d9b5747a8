/* Checks of the test programs: a check that fails ends the program with its line. */
#ifndef EXPECT_H
#define EXPECT_H

#include <inttypes.h>
#include <motion_rtl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program unless two integers are equal. */
#define EXPECT(left, right) expect((int64_t)(left), (int64_t)(right), #left, __FILE__, __LINE__)

/* Ends the program unless a text contains another one. */
#define CONTAINS(text, part) contains(text, part, __FILE__, __LINE__)

/* Ends the program unless a call fails with this code and a text that contains `part`. */
#define REFUSED(model, call, code, part)                                                           \
    do {                                                                                           \
        char why_[4096];                                                                           \
        int32_t length_;                                                                           \
        EXPECT(call, code);                                                                        \
        length_ = mrtl_error(model, why_, sizeof why_);                                            \
        EXPECT(length_, strlen(why_));                                                             \
        CONTAINS(why_, part);                                                                      \
    } while (0)

static inline void expect(int64_t left, int64_t right, const char *what, const char *file, int line)
{
    if (left != right) {
        fprintf(stderr, "%s:%d: %s is %" PRId64 ", not %" PRId64 "\n", file, line, what, left,
                right);
        exit(1);
    }
}

static inline void contains(const char *text, const char *part, const char *file, int line)
{
    if (strstr(text, part) == NULL) {
        fprintf(stderr, "%s:%d: \"%s\" does not contain \"%s\"\n", file, line, text, part);
        exit(1);
    }
}

/* Returns a model, or ends the program with the error. */
static inline mrtl_model created(const char *circuit, const char *settings)
{
    char why[1024];
    mrtl_model model = mrtl_new(circuit, settings, why, sizeof why);

    if (model < 0) {
        fprintf(stderr, "%s\n", why);
        exit(1);
    }
    return model;
}

/* Returns the index of a signal that exists. */
static inline int32_t found(mrtl_model model, const char *name)
{
    int32_t index = mrtl_find(model, name);

    EXPECT(index >= 0, 1);
    return index;
}

/* Returns the bits of a signal. */
static inline uint64_t bits_of(mrtl_model model, const char *name)
{
    uint64_t bits = 0;

    EXPECT(mrtl_get(model, found(model, name), &bits), MRTL_OK);
    return bits;
}

static inline uint64_t tick_of(mrtl_model model)
{
    uint64_t tick = UINT64_MAX;

    EXPECT(mrtl_tick(model, &tick), MRTL_OK);
    return tick;
}

#endif
