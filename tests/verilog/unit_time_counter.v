// unit_time_counter: counts the reference clock, pulses RST once per unit time.
// Made by motion-rtl from the circuit of that name.

module unit_time_counter (
    input  wire       clk,
    input  wire       rst,     // Registers to their power-on values; memories stay.
    input  wire [3:0] period,  // Unit time in ticks, constant from one RST to the next.
    output wire       unit_rst // RST: this is the last tick of the unit time.
);

    reg  [3:0] count = 4'd0; // Ticks since the unit time began.

    // Ticks of the unit time that are over after this one.
    wire [3:0] next = count + 4'd1;
    assign unit_rst = next >= period;

    always @(posedge clk)
        if (rst)
            count <= 4'd0;
        else if (unit_rst)
            count <= 4'd0;
        else
            count <= next;

endmodule
