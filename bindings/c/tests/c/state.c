/* Signals, ticks, resets, snapshots and waves. The argument is a path without extension. */
#include "expect.h"

static void descriptions(void)
{
    mrtl_model model = created("enable_counter", "width=8");
    mrtl_model wide = created("linear_interpolator", " widths.position=20 \n\nrule=truncating\n");
    int32_t period = found(model, "period"), count = found(model, "count");
    int32_t enable = found(model, "enable"), x = found(wide, "x");
    int64_t number = 0;
    char text[256];

    EXPECT(mrtl_abi(), MRTL_ABI);
    EXPECT(mrtl_version(text, sizeof text), 5);
    EXPECT(strcmp(text, "0.1.0"), 0);
    EXPECT(mrtl_count(model), 4);
    EXPECT(mrtl_width(model, period), 8);
    EXPECT(mrtl_width(model, enable), 1);
    EXPECT(mrtl_direction(model, period), MRTL_IN);
    EXPECT(mrtl_direction(model, count), MRTL_INNER);
    EXPECT(mrtl_direction(model, enable), MRTL_OUT);
    EXPECT(mrtl_role(model, period), MRTL_INPUT);
    EXPECT(mrtl_role(model, count), MRTL_REGISTER);
    EXPECT(mrtl_role(model, enable), MRTL_NET);
    EXPECT(mrtl_name(model, period, text, sizeof text), 6);
    EXPECT(strcmp(text, "period"), 0);
    EXPECT(mrtl_name(model, period, NULL, 0), 6);
    EXPECT(mrtl_name(model, period, text, 4), 6);
    EXPECT(strcmp(text, "per"), 0);
    EXPECT(mrtl_verilog_name(model, period, text, sizeof text), 6);
    EXPECT(mrtl_doc(model, period, text, sizeof text) > 10, 1);
    CONTAINS(text, "Ticks from one enable to the next");

    EXPECT(mrtl_is_signed(model, period), 0);
    EXPECT(mrtl_is_signed(wide, x), 1);
    EXPECT(mrtl_width(wide, x), 20);
    EXPECT(mrtl_set_signed(wide, found(wide, "target_x"), -5), MRTL_OK);
    EXPECT(bits_of(wide, "target_x"), 0xffffb);
    EXPECT(mrtl_get_signed(wide, found(wide, "target_x"), &number), MRTL_OK);
    EXPECT(number, -5);
    EXPECT(mrtl_free(wide), MRTL_OK);
    EXPECT(mrtl_free(model), MRTL_OK);
}

static void ticks(void)
{
    mrtl_model model = created("enable_counter", "width=40"), second;
    mrtl_snapshot state;

    EXPECT(mrtl_set(model, found(model, "period"), UINT64_C(1) << 39), MRTL_OK);
    EXPECT(mrtl_step(model, 0), MRTL_OK);
    EXPECT(tick_of(model), 0);
    EXPECT(mrtl_step(model, 1), MRTL_OK);
    EXPECT(mrtl_step(model, 59), MRTL_OK);
    EXPECT(tick_of(model), 60);
    EXPECT(bits_of(model, "count"), 60);

    state = mrtl_save(model);
    EXPECT(state > 0, 1);
    EXPECT(mrtl_reset(model), MRTL_OK);
    EXPECT(tick_of(model), 61);
    EXPECT(bits_of(model, "count"), 0);
    EXPECT(mrtl_fast_forward(model, (UINT64_C(1) << 39) - 1), MRTL_OK);
    EXPECT(bits_of(model, "enable"), 1);
    EXPECT(mrtl_restore(model, state), MRTL_OK);
    EXPECT(tick_of(model), 60);
    EXPECT(bits_of(model, "count"), 60);
    EXPECT(bits_of(model, "period"), INT64_C(1) << 39);

    /* In another model of the same circuit, and after the first one is freed. */
    EXPECT(mrtl_free(model), MRTL_OK);
    second = created("enable_counter", "width=40");
    EXPECT(mrtl_restore(second, state), MRTL_OK);
    EXPECT(mrtl_step(second, 1), MRTL_OK);
    EXPECT(bits_of(second, "count"), 61);
    EXPECT(mrtl_free_snapshot(state), MRTL_OK);
    EXPECT(mrtl_free(second), MRTL_OK);
}

static void waves(const char *base)
{
    mrtl_model model = created("enable_counter", "width=8");
    mrtl_snapshot state = mrtl_save(model);
    char path[4096];

    snprintf(path, sizeof path, "%s.vcd", base);
    EXPECT(mrtl_set(model, found(model, "period"), 10), MRTL_OK);
    EXPECT(mrtl_step(model, 1000), MRTL_OK);
    EXPECT(mrtl_waves(model, path), MRTL_OK);
    REFUSED(model, mrtl_waves(model, path), MRTL_WAVES, "mrtl_finish_waves() ends them");
    REFUSED(model, mrtl_restore(model, state), MRTL_WAVES, "mrtl_finish_waves() ends them");
    EXPECT(mrtl_step(model, 50), MRTL_OK);
    EXPECT(mrtl_finish_waves(model), MRTL_OK);
    REFUSED(model, mrtl_finish_waves(model), MRTL_WAVES, "no waves were begun");
    EXPECT(mrtl_restore(model, state), MRTL_OK);

    /* Waves that are never finished leave no file. */
    snprintf(path, sizeof path, "%s_lost.fst", base);
    EXPECT(mrtl_waves(model, path), MRTL_OK);
    EXPECT(mrtl_step(model, 5), MRTL_OK);
    EXPECT(mrtl_free(model), MRTL_OK);
    EXPECT(mrtl_free_snapshot(state), MRTL_OK);
}

int main(int argc, char **argv)
{
    EXPECT(argc, 2);
    descriptions();
    ticks();
    waves(argv[1]);
    printf("PASS\n");
    return 0;
}
