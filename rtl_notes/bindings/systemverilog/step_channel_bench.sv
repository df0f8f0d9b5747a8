// Drives step_channel with random unit times and half-periods. The bench checks nothing; a checker
// that is bound to step_channel does.
`timescale 1ns / 1ps

module step_channel_bench;

    reg        clk = 1'b0;
    reg        srst = 1'b1;
    reg [15:0] next_half = 16'd0;
    reg [15:0] next_limit = 16'd20;
    integer    cycle = 0;

    step_channel #(.LIMIT_W (16)) dut (
        .clk          (clk),
        .srst         (srst),
        .i_next_half  (next_half),
        .i_next_limit (next_limit),
        .o_step_n     ()
    );

    always #5 clk = ~clk;

    always @(posedge clk) begin
        cycle <= cycle + 1;
        srst <= cycle < 3 || $urandom_range(499) == 0;
        if ($urandom_range(49) == 0) begin
            next_half <= 16'($urandom_range(9));
            next_limit <= 16'($urandom_range(60));
        end
        if (cycle == 20000) $finish;
    end

endmodule
