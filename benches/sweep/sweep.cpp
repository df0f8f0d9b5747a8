// Every case from FIRST on: two increments on a line, I and B against quotient and rest.
#include "Vtop.h"
#include "verilated.h"
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

// Bits and ticks of the integrator: one bit of the product and one of the quotient a tick.
static const int P = 8;
static const int LATENCY = 3 * P + 2;
static const int SCAN = LATENCY + 1;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const uint64_t first = strtoull(argv[1], nullptr, 10), cases = strtoull(argv[2], nullptr, 10);
    VerilatedContext context;
    Vtop top{&context};
    top.rst = 0;
    const auto begun = std::chrono::steady_clock::now();
    for (uint64_t index = first; index != first + cases; ++index) {
        const int increment = int8_t(index), sum = int8_t(index >> 8);
        const int slave = int8_t(index >> 16), master = int8_t(index >> 24);
        if (master == 0) continue;
        top.master = uint8_t(master);
        top.slave = uint8_t(slave);
        bool right = true, early = false;
        for (int tick = 0; tick <= 2 * SCAN; ++tick) {
            top.clear = tick == 0;
            top.start = tick == 1 || tick == 1 + SCAN;
            top.increment = uint8_t(tick > SCAN ? increment : sum);
            top.clk = 0;
            top.eval();
            if (tick == SCAN || tick == 2 * SCAN) {
                right = right && top.valid;
            } else if (tick > 0) {
                // In tick 0 that of the case before may still stand.
                early = early || top.valid;
            }
            if (tick == 2 * SCAN) {
                const int along = slave * (sum + increment);
                int quotient = along / master;
                if (along % master != 0 && (along < 0) != (master < 0)) --quotient;
                const int rest = along - quotient * master;
                right = right && int8_t(top.integral) == int8_t(quotient) && int8_t(top.remainder) == rest;
            }
            top.clk = 1;
            top.eval();
        }
        if (!right || early) {
            fprintf(stderr, "case %llu\n", static_cast<unsigned long long>(index));
            return 1;
        }
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    printf("%.9f\n", taken.count());
    return 0;
}
