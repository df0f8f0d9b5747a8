// Testbench of enable_counter.
//
// Applies enable_counter.stimulus, a line a tick, and dumps every signal.
// A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
// is what stands before a rising edge of clk; inputs change soon after it.

module enable_counter_tb;

    reg clk = 1'b0;
    reg [4:0] stimulus;
    reg [4:0] line;
    integer file, items;

    enable_counter dut (
        .clk (clk),
        .rst (stimulus[4]),
        .period (stimulus[3:0]),
        .enable ()
    );

    initial begin
        file = $fopen("enable_counter.stimulus", "r");
        if (file == 0) begin
            $display("enable_counter.stimulus cannot be opened");
            $finish;
        end
        items = $fscanf(file, "%h", stimulus);
        $dumpfile("enable_counter_tb.vcd");
        $dumpvars(0, dut);
        while (items == 1) begin
            #5 items = $fscanf(file, "%h", line);
            if (items == 1) begin
                clk = 1'b1;
                #1 stimulus = line;
                #4 clk = 1'b0;
            end
        end
        $finish;
    end

endmodule
