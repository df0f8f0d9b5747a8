/* Times of calls: every input port set, every output port read, one step, in nanoseconds of CPU
 * time per tick. Arguments: a circuit and the number of ticks.
 */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <motion_rtl.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double cpu_seconds(void)
{
    struct timespec time;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

int main(int argc, char **argv)
{
    char why[1024];
    double begin, made, first, end;
    uint64_t ticks = argc > 2 ? strtoull(argv[2], NULL, 10) : 1000000, tick, sum = 0, bits;
    int32_t *inputs, *outputs, *widths, count, index, ins = 0, outs = 0, failed = 0;
    mrtl_model model;

    if (argc < 2) {
        fprintf(stderr, "usage: speed CIRCUIT [TICKS]\n");
        return 2;
    }
    begin = cpu_seconds();
    model = mrtl_new(argv[1], NULL, why, sizeof why);
    if (model < 0) {
        fprintf(stderr, "error: %s\n", why);
        return 2;
    }
    made = cpu_seconds();
    failed |= mrtl_step(model, 1);
    first = cpu_seconds();

    count = mrtl_count(model);
    inputs = malloc(sizeof *inputs * (size_t)count);
    outputs = malloc(sizeof *outputs * (size_t)count);
    widths = malloc(sizeof *widths * (size_t)count);
    if (inputs == NULL || outputs == NULL || widths == NULL)
        return 2;
    for (index = 0; index < count; index++) {
        if (mrtl_direction(model, index) == MRTL_IN) {
            widths[ins] = mrtl_width(model, index);
            inputs[ins++] = index;
        } else if (mrtl_direction(model, index) == MRTL_OUT) {
            outputs[outs++] = index;
        }
    }
    printf("%s: created in %.1f ms, first tick %.1f ms\n", argv[1], 1e3 * (made - begin),
           1e3 * (first - made));

    /* Caches are warm when the measurement begins. */
    for (tick = 0; tick < 20000; tick++)
        failed |= mrtl_step(model, 1);
    begin = cpu_seconds();
    for (tick = 0; tick < ticks; tick++)
        failed |= mrtl_step(model, 1);
    end = cpu_seconds();
    printf("step alone: %.1f ns\n", 1e9 * (end - begin) / (double)ticks);

    begin = cpu_seconds();
    for (tick = 0; tick < ticks; tick++) {
        for (index = 0; index < ins; index++)
            failed |= mrtl_set(model, inputs[index], tick >> 6 & ((UINT64_C(2) << (widths[index] - 1)) - 1));
        for (index = 0; index < outs; index++) {
            failed |= mrtl_get(model, outputs[index], &bits);
            sum += bits;
        }
        failed |= mrtl_step(model, 1);
    }
    end = cpu_seconds();
    printf("%d ports set, %d read, a step: %.1f ns (%d calls, sum %" PRIu64 ")\n", ins, outs,
           1e9 * (end - begin) / (double)ticks, ins + outs + 1, sum);
    mrtl_free(model);
    return failed == 0 ? 0 : 1;
}
