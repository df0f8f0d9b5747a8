// Drives linear_interpolator with random targets and a scan every 64 ticks.
`timescale 1ns / 1ps

module bench (input wire clk, output wire [31:0] seen);
    reg rst = 1'b1;
    reg scan = 1'b0, hold = 1'b0, push = 1'b0, halt = 1'b0;
    reg signed [31:0] target_x = 0, target_y = 0;
    reg [31:0] speed = 0;
    reg [11:0] acceleration_time = 0, deceleration_time = 0;
    wire signed [31:0] x, y;
    wire start, load, ready, busy, late, refused, home;
    reg [31:0] cycle = 0, random = 32'h0123_4567;

    linear_interpolator dut (
        .clk (clk),
        .rst (rst),
        .scan (scan),
        .hold (hold),
        .push (push),
        .target_x (target_x),
        .target_y (target_y),
        .speed (speed),
        .acceleration_time (acceleration_time),
        .deceleration_time (deceleration_time),
        .halt (halt),
        .clear (1'b0),
        .x (x),
        .y (y),
        .start (start),
        .load (load),
        .ready (ready),
        .busy (busy),
        .late (late),
        .refused (refused),
        .home (home)
    );
    // What nobody sees would be left out.
    assign seen = x ^ y ^ {25'd0, start, load, ready, busy, late, refused, home};

    always @(posedge clk) begin
        cycle <= cycle + 1;
        rst <= cycle < 2;
        random <= {random[30:0], random[31] ^ random[21] ^ random[1] ^ random[0]};
        scan <= cycle[5:0] == 0;
        hold <= random[9:2] == 5;
        halt <= random[15:0] == 1;
        push <= ready && random[3:0] == 0;
        if (ready && random[3:0] == 0) begin
            target_x <= {{20{random[31]}}, random[31:20]};
            target_y <= {{20{random[19]}}, random[19:8]};
            speed <= {16'd0, random[20:5]};
            acceleration_time <= {8'd0, random[11:8]};
            deceleration_time <= {8'd0, random[15:12]};
        end
    end
endmodule
