// Testbench of enable_counter.
//
// Applies enable_counter.stimulus, a line a tick, and dumps every signal.
// A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
// is what stands before a rising edge of clk; inputs change with its falling edge.
//
// Holds the ports out against enable_counter.expected, a line a tick.
// A line is a hexadecimal word: the ports out side by side, the first lowest. The last line printed
// begins with PASS, or lines begin with FAIL and $fatal ends the simulation.

`timescale 100ns / 100ns

module enable_counter_tb;

    reg  clk = 1'b0;
    reg  [4:0] stimulus;
    reg  [4:0] line;
    integer file, items, tick;
    wire [0:0] seen;
    reg  [0:0] expected;
    integer golden, differ;

    enable_counter dut (
        .clk (clk),
        .rst (stimulus[4]),
        .period (stimulus[3:0]),
        .enable (seen[0])
    );

    initial begin
        file = $fopen("enable_counter.stimulus", "r");
        if (file == 0) begin
            $display("FAIL: enable_counter.stimulus cannot be opened");
            $fatal;
        end
        golden = $fopen("enable_counter.expected", "r");
        if (golden == 0) begin
            $display("FAIL: enable_counter.expected cannot be opened");
            $fatal;
        end
        differ = 0;
        $dumpfile("enable_counter_tb.vcd");
        $dumpvars(0, dut);
        tick = 0;
        items = $fscanf(file, "%h", stimulus);
        while (items == 1) begin
            #5;
            items = $fscanf(golden, "%h", expected);
            if (items != 1) begin
                $display("FAIL: tick %0d: enable_counter.expected has no line for it", tick);
                $fatal;
            end
            if (seen !== expected) begin
                // The waves show what follows from the first difference.
                if (differ == 0) begin
                    if (seen[0] !== expected[0])
                        $display("FAIL: tick %0d: enable is %h, expected %h",
                            tick, seen[0], expected[0]);
                end
                differ = differ + 1;
            end
            tick = tick + 1;
            items = $fscanf(file, "%h", line);
            if (items == 1) begin
                clk = 1'b1;
                #5 clk = 1'b0;
                stimulus = line;
            end
        end
        items = $fscanf(golden, "%h", expected);
        if (items == 1 || tick == 0) begin
            $display("FAIL: enable_counter.expected is not of a run of %0d ticks", tick);
            $fatal;
        end
        if (differ != 0) begin
            $display("FAIL: ports out differ in %0d of %0d ticks", differ, tick);
            $write("motion-rtl compare enable_counter.vcd ");
            $display("enable_counter_tb.vcd shows every signal that differs");
            $fatal;
        end
        $display("PASS: ports out are as expected in all of %0d ticks", tick);
        $finish;
    end

endmodule
