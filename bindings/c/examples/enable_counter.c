/* A design in C beside the model of the same circuit: the enable counter, one enable in every
 * `period` ticks. Both get the same random inputs, and their ports are compared in every tick.
 *
 * Prints PASS, FAIL with the first difference, or VACUOUS if the output port never moved; exits
 * with 0 for PASS only. With the argument `fault` the design has a fault.
 */
#include <inttypes.h>
#include <motion_rtl.h>
#include <stdio.h>
#include <string.h>

#define TICKS 100000

/* Ports in period 8 unsigned, out enable 1 unsigned; see mrtl_check. */
#define PORTS UINT64_C(0xfcb7d404ef2aff37)

struct design {
    uint8_t count;
    int fault;
};

static int enable_of(const struct design *design, uint8_t period)
{
    uint8_t next = (uint8_t)(design->count + 1);

    /* The fault: a period that becomes shorter is missed. */
    return design->fault ? next == period : next >= period;
}

static void clock_edge(struct design *design, uint8_t period)
{
    design->count = enable_of(design, period) ? 0 : (uint8_t)(design->count + 1);
}

static uint32_t random_word(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static int failed(mrtl_model model, const char *what)
{
    char text[1024];

    mrtl_error(model, text, sizeof text);
    fprintf(stderr, "error: %s: %s\n", what, text);
    return 2;
}

int main(int argc, char **argv)
{
    struct design design = {0, argc > 1 && strcmp(argv[1], "fault") == 0};
    char text[1024];
    uint32_t state = 1;
    uint8_t period = 5;
    uint64_t enable, before = 0, moved = 0, tick;
    mrtl_model model;
    int32_t period_in, enable_out;

    model = mrtl_new("enable_counter", "width=8", text, sizeof text);
    if (model < 0) {
        fprintf(stderr, "error: %s\n", text);
        return 2;
    }
    if (mrtl_check(model, MRTL_ABI, PORTS) != MRTL_OK)
        return failed(model, "mrtl_check");
    period_in = mrtl_find(model, "period");
    if (period_in < 0)
        return failed(model, "mrtl_find");
    enable_out = mrtl_find(model, "enable");
    if (enable_out < 0)
        return failed(model, "mrtl_find");

    for (tick = 0; tick < TICKS; tick++) {
        if (random_word(&state) % 16 == 0)
            period = (uint8_t)(random_word(&state) % 20 + 1);
        if (mrtl_set(model, period_in, period) != MRTL_OK)
            return failed(model, "mrtl_set");
        if (mrtl_get(model, enable_out, &enable) != MRTL_OK)
            return failed(model, "mrtl_get");
        if (enable != (uint64_t)enable_of(&design, period)) {
            printf("FAIL: tick %" PRIu64 ": enable: design %d, model %" PRIu64 "\n", tick,
                   enable_of(&design, period), enable);
            return 1;
        }
        moved += enable != before;
        before = enable;
        clock_edge(&design, period);
        if (mrtl_step(model, 1) != MRTL_OK)
            return failed(model, "mrtl_step");
    }
    mrtl_free(model);
    if (moved == 0) {
        printf("VACUOUS: enable never moved\n");
        return 1;
    }
    printf("PASS: %d ticks compared, enable moved %" PRIu64 " times\n", TICKS, moved);
    return 0;
}
