// Enable counter with other names: the period in bits of a bus, an enable that is active low, and
// a reset that is active low.
module packed_counter (
    input  wire        clk,
    input  wire        rst_n,
    input  wire [31:4] bus,
    input  wire [0:7]  ascending,
    output wire [1:0]  both
);
    reg [7:0] count = 8'd0;
    wire [7:0] next = count + 8'd1;
    wire enable = next >= bus[15:8];
    assign both = {~enable, ascending[0]};
    always @(posedge clk) count <= ~rst_n | enable ? 8'd0 : next;
endmodule
