// Unit-time counter (30).  o_lap is combinational and high in the last clock
// cycle of every lap of i_limit cycles; limits 0 and 1 both mark every cycle.
`timescale 1ns / 1ps

module tick_timer #(
    parameter WIDTH = 24
) (
    input  wire             clk,
    input  wire             srst,     // synchronous, active high
    input  wire [WIDTH-1:0] i_limit,
    output wire             o_lap
);

    localparam [WIDTH-1:0] ONE = {{(WIDTH-1){1'b0}}, 1'b1};

    reg  [WIDTH-1:0] cnt_q = {WIDTH{1'b0}};
    wire [WIDTH-1:0] cnt_up = cnt_q + ONE;

    // cnt_q never gets to all ones, so the WIDTH-bit sum cannot wrap.
    assign o_lap = (cnt_up >= i_limit);

    always @(posedge clk)
        if (srst || o_lap) cnt_q <= {WIDTH{1'b0}};
        else               cnt_q <= cnt_up;

endmodule
