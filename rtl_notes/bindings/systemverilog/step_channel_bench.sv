// Drives step_channel with random unit times and half-periods. The bench checks nothing; a checker
// that is bound to step_channel does.
`timescale 1ns / 1ps

module step_channel_bench;

    reg        clk = 1'b0;
    reg        srst = 1'b1;
    reg [15:0] next_half = 16'd0;
    reg [15:0] next_limit = 16'd20;
    reg [31:0] random = 32'h0123_4567;
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
        random <= {random[30:0], random[31] ^ random[21] ^ random[1] ^ random[0]};
        srst <= cycle < 3 || random[8:0] == 0;
        if (random[14:9] == 0) begin
            next_half <= {12'd0, random[31:28]};
            next_limit <= {10'd0, random[27:22]};
        end
        if (cycle == 20000) $finish;
    end

endmodule
