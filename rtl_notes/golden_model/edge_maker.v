// Pulse generator (20 = 201 + 202), safe variant.  o_wave is combinational:
// it shows the level that level_q takes with the coming clock edge, save that
// i_lap clears level_q only.
`timescale 1ns / 1ps

module edge_maker #(
    parameter WIDTH = 16
) (
    input  wire             clk,
    input  wire             srst,     // synchronous, active high
    input  wire             i_lap,    // last cycle of the unit time
    input  wire [WIDTH-1:0] i_half,   // half-period, 0: silent
    output wire             o_wave
);

    localparam [WIDTH-1:0] ONE = {{(WIDTH-1){1'b0}}, 1'b1};

    reg  [WIDTH-1:0] run_q = {WIDTH{1'b0}};
    reg              level_q = 1'b0;

    wire [WIDTH-1:0] run_up = run_q + ONE;
    wire             due    = (run_up >= i_half);   // true for i_half = 0
    wire             mute   = ~|i_half;

    assign o_wave = (level_q ^ due) & ~mute;

    always @(posedge clk) begin
        if (srst || i_lap || due) run_q <= {WIDTH{1'b0}};
        else                      run_q <= run_up;

        if (srst || i_lap)        level_q <= 1'b0;
        else                      level_q <= o_wave;
    end

endmodule
