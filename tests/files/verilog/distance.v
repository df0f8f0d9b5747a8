// distance: how far a position moves in a tick.
// Made by motion-rtl from the circuit of that name.

`timescale 1ns / 1ps

module distance (
    input  wire              clk,
    input  wire              rst,      // Registers to their power-on values; memories stay.
    input  wire signed [3:0] position, // A position.
    output wire signed [3:0] old,      // The position a tick ago.
    output wire signed [4:0] moved     // By how much it moved.
);

    reg  signed [3:0] old_reg = 4'sd0;
    reg  signed [4:0] moved_reg = 5'sd0;
    assign old = old_reg;
    assign moved = moved_reg;

    always @(posedge clk)
        if (rst) begin
            old_reg <= 4'sd0;
            moved_reg <= 5'sd0;
        end else begin
            old_reg <= position;
            moved_reg <= $signed({{1{position[3]}}, position}) - $signed({{1{old[3]}}, old});
        end

`ifdef FORMAL
    reg f_past_valid = 1'b0;
    always @(posedge clk)
        f_past_valid <= 1'b1;

    reg signed [3:0] past_position;
    reg signed [3:0] past_old;
    always @(posedge clk) begin
        past_position <= position;
        past_old <= old;
    end
    wire [4:0] f_value = $unsigned(moved);
    wire [3:0] f_value_2 = $unsigned(past_position - past_old);

    always @(posedge clk) begin
        // From where it was to where it is.
        if (f_past_valid && !$past(rst))
            assert ($signed({{1{past_old[3]}}, past_old}) + moved ==
                $signed({{1{past_position[3]}}, past_position}));
        // A part of a difference is that of the exact one.
        if (f_past_valid && !$past(rst))
            assert (f_value_2[3:1] == f_value[3:1]);
    end
`endif

endmodule
