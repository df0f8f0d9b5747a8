// Runs a Verilated circuit on a recorded stimulus, as often as standard input asks for it.
#include "Vtop.h"
#include "verilated.h"
#if VM_TRACE_FST
#include "verilated_fst_c.h"
typedef VerilatedFstC Waves;
#elif VM_TRACE
#include "verilated_vcd_c.h"
typedef VerilatedVcdC Waves;
#endif
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

typedef std::chrono::steady_clock Clock;

struct Change {
    uint32_t tick, port;
    uint64_t value;
};

static inline uint64_t rotated(uint64_t word, unsigned bits) {
    return bits ? word << bits | word >> (64 - bits) : word;
}

// apply(top, port, value) and outputs(top), made from the ports of the circuit.
#include "ports.h"

static std::vector<Change> stimulus;
static uint64_t ticks, traced_from;

// A tick is what stands before a rising edge: inputs, settled nets, then the edge.
template <uint64_t EVERY>
static uint64_t run(Vtop& top, const Change*& next, uint64_t end) {
    uint64_t sum = 0;
    for (uint64_t tick = 0; tick < end; ++tick) {
        for (; next->tick == tick; ++next) apply(top, next->port, next->value);
        top.clk = 0;
        top.eval();
        if (tick % EVERY == 0) sum = rotated(sum, 1) + outputs(top);
        top.clk = 1;
        top.eval();
    }
    return sum;
}

#if VM_TRACE
// The same with waves of the last ticks: what ours show at the same times, clk too. Their head and
// the ticks before them take no time.
static uint64_t dump(Vtop& top, const char* path, Clock::time_point& begun) {
    Waves waves;
    top.trace(&waves, 99);
    const Change* next = stimulus.data();
    uint64_t sum = run<1>(top, next, traced_from);
    waves.open(path);
    begun = Clock::now();
    for (uint64_t tick = traced_from; tick < ticks; ++tick) {
        for (; next->tick == tick; ++next) apply(top, next->port, next->value);
        top.eval();
        waves.dump(10 * tick);
        top.clk = 0;
        top.eval();
        waves.dump(10 * tick + 5);
        sum = rotated(sum, 1) + outputs(top);
        top.clk = 1;
        top.eval();
    }
    waves.close();
    return sum;
}
#endif

int main(int, char** argv) {
    FILE* file = std::fopen(argv[1], "rb");
    ticks = std::strtoull(argv[2], nullptr, 10);
    traced_from = std::strtoull(argv[3], nullptr, 10);
    Change change;
    while (file && std::fread(&change, sizeof change, 1, file) == 1) stimulus.push_back(change);
    if (stimulus.empty()) return 1;
    char line[4096];
    while (std::fgets(line, sizeof line, stdin)) {
        line[std::strcspn(line, "\n")] = 0;
        auto context = std::make_unique<VerilatedContext>();
#if VM_TRACE
        context->traceEverOn(true);
#endif
        auto top = std::make_unique<Vtop>(context.get());
        top->rst = 0;
        top->clk = 0;
        top->eval();
        uint64_t sum = 0;
        auto begun = Clock::now();
#if VM_TRACE
        sum = dump(*top, line, begun);
#else
        const Change* next = stimulus.data();
        if (!std::strcmp(line, "every")) sum = run<1>(*top, next, ticks);
        if (!std::strcmp(line, "seldom")) sum = run<SELDOM>(*top, next, ticks);
#endif
        const std::chrono::nanoseconds taken = Clock::now() - begun;
        std::printf("%lld %llu\n", (long long)taken.count(), (unsigned long long)sum);
        std::fflush(stdout);
    }
    return 0;
}
