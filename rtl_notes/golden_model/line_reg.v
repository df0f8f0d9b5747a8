// Sync stage (40).  The step line leaves the chip active low (it sinks the
// driver's opto-coupler), so "step low" of the note is o_step_n = 1.
`timescale 1ns / 1ps

module line_reg (
    input  wire clk,
    input  wire srst,      // synchronous, active high
    input  wire i_lap,
    input  wire i_wave,
    output wire o_step_n
);

    reg drive_nq = 1'b1;

    always @(posedge clk)
        drive_nq <= srst | i_lap | ~i_wave;

    assign o_step_n = drive_nq;

endmodule
