// Runs the bench for a number of ticks, and prints the CPU time of a tick.
#include "Vbench.h"
#include "verilated.h"
#include <cstdio>
#include <cstdlib>
#include <ctime>

static double cpu_seconds() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + time.tv_nsec * 1e-9;
}

int main(int argc, char **argv) {
    VerilatedContext context;
    context.commandArgs(argc, argv);
    Vbench top{&context};
    const long ticks = argc > 1 ? std::atol(argv[1]) : 1000000;
    top.clk = 0;
    top.eval();
    const double begin = cpu_seconds();
    for (long tick = 0; tick < ticks; tick++) {
        top.clk = 1;
        top.eval();
        top.clk = 0;
        top.eval();
    }
    const double seconds = cpu_seconds() - begin;
    top.final();
    std::printf("%.1f\n", seconds * 1e9 / ticks);
}
