// Bench: plays unit_law.stimulus into a step channel and dumps everything.
//
// A line of the file is a clock cycle: {reset, next limit, next half-period} in hexadecimal.
// The inputs change with the falling edge and are taken by the rising edge behind it. The last word
// has no falling edge behind it: a tick is over with its rising edge.
`timescale 1ns / 1ps

module step_channel_tb;

    reg         clk_100 = 1'b0;
    reg  [32:0] vec;
    reg  [32:0] following;
    integer     fd;
    integer     got;

    wire        step_n;

    step_channel #(.HALF_W(16), .LIMIT_W(16)) dut (
        .clk          (clk_100),
        .srst         (vec[32]),
        .i_next_half  (vec[15:0]),
        .i_next_limit (vec[31:16]),
        .o_step_n     (step_n)
    );

    initial begin
        fd = $fopen("unit_law.stimulus", "r");
        if (fd == 0) begin
            $display("unit_law.stimulus cannot be opened");
            $finish;
        end
        $dumpfile("step_channel_tb.vcd");
        $dumpvars(0, step_channel_tb);
        got = $fscanf(fd, "%h", vec);
        while (got == 1) begin
            #5 clk_100 = 1'b1;
            #5 got = $fscanf(fd, "%h", following);
            if (got == 1) begin
                clk_100 = 1'b0;
                vec = following;
            end
        end
        $finish;
    end

endmodule
