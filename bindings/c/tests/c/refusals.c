/* Wrong names, settings, handles, indices, values and pointers: each is an error with a text. */
#include "expect.h"

/* Every function with a handle refuses one that no model has. */
static void wrong_handle(mrtl_model model, int32_t code)
{
    char text[64];
    uint64_t bits = 7;
    int64_t number = 7;

    EXPECT(mrtl_check(model, MRTL_ABI, 0), code);
    EXPECT(mrtl_count(model), code);
    EXPECT(mrtl_find(model, "period"), code);
    EXPECT(mrtl_name(model, 0, text, sizeof text), code);
    EXPECT(mrtl_verilog_name(model, 0, text, sizeof text), code);
    EXPECT(mrtl_doc(model, 0, text, sizeof text), code);
    EXPECT(mrtl_width(model, 0), code);
    EXPECT(mrtl_is_signed(model, 0), code);
    EXPECT(mrtl_direction(model, 0), code);
    EXPECT(mrtl_role(model, 0), code);
    EXPECT(mrtl_set(model, 0, 1), code);
    EXPECT(mrtl_set_signed(model, 0, 1), code);
    EXPECT(mrtl_get(model, 0, &bits), code);
    EXPECT(mrtl_get_signed(model, 0, &number), code);
    EXPECT(mrtl_tick(model, &bits), code);
    EXPECT(mrtl_step(model, 1), code);
    EXPECT(mrtl_fast_forward(model, 1), code);
    EXPECT(mrtl_reset(model), code);
    EXPECT(mrtl_save(model), code);
    EXPECT(mrtl_restore(model, 1), code);
    EXPECT(mrtl_waves(model, "never.vcd"), code);
    EXPECT(mrtl_finish_waves(model), code);
    EXPECT(mrtl_error(model, text, sizeof text), code);
    CONTAINS(text, "no model has the handle");
    EXPECT(mrtl_free(model), code);
    EXPECT(bits, 7);
    EXPECT(number, 7);
}

static void no_model(void)
{
    char why[1024], cut[8];

    EXPECT(mrtl_new("enable_countr", NULL, why, sizeof why), MRTL_UNKNOWN);
    CONTAINS(why, "no circuit is called enable_countr; did you mean enable_counter?");
    EXPECT(mrtl_new("enable_countr", NULL, cut, sizeof cut), MRTL_UNKNOWN);
    EXPECT(strcmp(cut, "no circ"), 0);
    EXPECT(mrtl_new("enable_countr", NULL, NULL, 0), MRTL_UNKNOWN);
    EXPECT(mrtl_new(NULL, NULL, why, sizeof why), MRTL_NULL);
    CONTAINS(why, "circuit is NULL");
    EXPECT(mrtl_new("\xff", NULL, why, sizeof why), MRTL_NOT_UTF8);
    EXPECT(mrtl_new("enable_counter", "widht=8", why, sizeof why), MRTL_SETTINGS);
    CONTAINS(why, "widht");
    CONTAINS(why, "width");
    EXPECT(mrtl_new("enable_counter", "width=99", why, sizeof why), MRTL_SETTINGS);
    CONTAINS(why, "enable_counter");
    EXPECT(mrtl_new("enable_counter", "width=8\n\nwidth", why, sizeof why), MRTL_SETTINGS);
    CONTAINS(why, "settings, line 3");
    EXPECT(mrtl_new("enable_counter", "width=8\nwidth=9", why, sizeof why), MRTL_SETTINGS);
    CONTAINS(why, "settings: width: given twice; allowed: once");
    /* The text of an error without a buffer for it is left out. */
    EXPECT(mrtl_new("enable_countr", NULL, NULL, 8), MRTL_UNKNOWN);
}

static void no_signal(mrtl_model model)
{
    int32_t period = found(model, "period"), count = found(model, "count");
    int32_t past = mrtl_count(model);
    uint64_t bits = 7;

    REFUSED(model, mrtl_find(model, "perod"), MRTL_UNKNOWN, "no signal perod; near it: period");
    REFUSED(model, mrtl_find(model, NULL), MRTL_NULL, "name is NULL");
    REFUSED(model, mrtl_find(model, "\xff"), MRTL_NOT_UTF8, "name is not UTF-8 from byte 0 on");
    REFUSED(model, mrtl_get(model, -1, &bits), MRTL_WRONG_INDEX, "no signal has the index -1");
    REFUSED(model, mrtl_get(model, past, &bits), MRTL_WRONG_INDEX, "allowed are 0 to 3");
    REFUSED(model, mrtl_set(model, past, 0), MRTL_WRONG_INDEX, "allowed are 0 to 3");
    REFUSED(model, mrtl_width(model, past), MRTL_WRONG_INDEX, "allowed are 0 to 3");
    REFUSED(model, mrtl_name(model, past, NULL, 0), MRTL_WRONG_INDEX, "allowed are 0 to 3");
    REFUSED(model, mrtl_set(model, count, 1), MRTL_NO_INPUT, "count is a register");
    REFUSED(model, mrtl_set_signed(model, count, 1), MRTL_NO_INPUT, "count is a register");
    REFUSED(model, mrtl_set(model, period, 256), MRTL_VALUE, "tick 0: port in period: 256");
    REFUSED(model, mrtl_set(model, period, UINT64_MAX), MRTL_VALUE, "does not fit");
    REFUSED(model, mrtl_set_signed(model, period, -1), MRTL_VALUE, "allowed are 0 to 255");
    REFUSED(model, mrtl_get(model, period, NULL), MRTL_NULL, "bits is NULL");
    REFUSED(model, mrtl_get_signed(model, period, NULL), MRTL_NULL, "number is NULL");
    REFUSED(model, mrtl_tick(model, NULL), MRTL_NULL, "tick is NULL");
    REFUSED(model, mrtl_name(model, period, NULL, 4), MRTL_NULL, "text is NULL");
    EXPECT(mrtl_error(model, NULL, 4), MRTL_NULL);
    EXPECT(bits, 7);
    EXPECT(bits_of(model, "period"), 0);
}

static void other_bench(mrtl_model model)
{
    REFUSED(model, mrtl_check(model, MRTL_ABI + 1, 0), MRTL_MISMATCH, "made for ABI");
    REFUSED(model, mrtl_check(model, MRTL_ABI, 1), MRTL_MISMATCH, "in period 8 unsigned\nout enable");
    REFUSED(model, mrtl_check(model, MRTL_ABI, 1), MRTL_MISMATCH, "0xfcb7d404ef2aff37");
    EXPECT(mrtl_check(model, MRTL_ABI, UINT64_C(0xfcb7d404ef2aff37)), MRTL_OK);
}

int main(void)
{
    mrtl_model model = created("enable_counter", "width=8"), other;
    mrtl_snapshot state;

    EXPECT(mrtl_error(model, NULL, 0), 0);
    no_model();
    no_signal(model);
    other_bench(model);

    REFUSED(model, mrtl_waves(model, NULL), MRTL_NULL, "path is NULL");
    REFUSED(model, mrtl_waves(model, "a.txt"), MRTL_WAVES, "allowed: .vcd, .fst");
    REFUSED(model, mrtl_finish_waves(model), MRTL_WAVES, "no waves were begun");

    other = created("enable_counter", "width=9");
    state = mrtl_save(other);
    EXPECT(state > 0, 1);
    REFUSED(model, mrtl_restore(model, state), MRTL_OTHER_CIRCUIT, "snapshot");
    REFUSED(model, mrtl_restore(model, model), MRTL_WRONG_HANDLE, "no snapshot has the handle");
    EXPECT(mrtl_free_snapshot(model), MRTL_WRONG_HANDLE);
    wrong_handle(state, MRTL_WRONG_HANDLE);
    EXPECT(mrtl_free_snapshot(state), MRTL_OK);
    EXPECT(mrtl_free_snapshot(state), MRTL_WRONG_HANDLE);
    REFUSED(model, mrtl_restore(model, state), MRTL_WRONG_HANDLE, "no snapshot has the handle");

    EXPECT(mrtl_step(other, 1), MRTL_OK);
    EXPECT(mrtl_free(other), MRTL_OK);
    wrong_handle(other, MRTL_WRONG_HANDLE);
    wrong_handle(0, MRTL_WRONG_HANDLE);
    wrong_handle(-1, MRTL_WRONG_HANDLE);
    wrong_handle(INT32_MIN, MRTL_WRONG_HANDLE);
    wrong_handle(INT32_MAX, MRTL_WRONG_HANDLE);

    /* None of it has changed the model. */
    EXPECT(tick_of(model), 0);
    EXPECT(mrtl_step(model, 1), MRTL_OK);
    EXPECT(mrtl_free(model), MRTL_OK);
    printf("PASS\n");
    return 0;
}
