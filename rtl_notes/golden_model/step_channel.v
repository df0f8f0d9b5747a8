// One step channel: timer, edge maker and line register in a chain, with the
// holding registers for the unit time that runs.
`timescale 1ns / 1ps

module step_channel #(
    parameter HALF_W  = 16,
    parameter LIMIT_W = 24
) (
    input  wire               clk,
    input  wire               srst,          // synchronous, active high
    input  wire [HALF_W-1:0]  i_next_half,   // taken in the last cycle of
    input  wire [LIMIT_W-1:0] i_next_limit,  // a unit time, for the next one
    output wire               o_step_n
);

    localparam [LIMIT_W-1:0] LIMIT_INIT = {{(LIMIT_W-1){1'b0}}, 1'b1};

    reg [HALF_W-1:0]  half_q  = {HALF_W{1'b0}};
    reg [LIMIT_W-1:0] limit_q = LIMIT_INIT;

    wire lap;
    wire wave;

    always @(posedge clk)
        if (srst) begin
            half_q  <= {HALF_W{1'b0}};
            limit_q <= LIMIT_INIT;
        end else if (lap) begin
            half_q  <= i_next_half;
            limit_q <= i_next_limit;
        end

    tick_timer #(.WIDTH(LIMIT_W)) u_timer (
        .clk     (clk),
        .srst    (srst),
        .i_limit (limit_q),
        .o_lap   (lap)
    );

    edge_maker #(.WIDTH(HALF_W)) u_edges (
        .clk    (clk),
        .srst   (srst),
        .i_lap  (lap),
        .i_half (half_q),
        .o_wave (wave)
    );

    line_reg u_line (
        .clk      (clk),
        .srst     (srst),
        .i_lap    (lap),
        .i_wave   (wave),
        .o_step_n (o_step_n)
    );

endmodule
