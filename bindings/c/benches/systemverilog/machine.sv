// Drives machine: one of its input ports changes in about every other tick.
`timescale 1ns / 1ps

module bench (input wire clk, output wire [31:0] seen);
    reg rst = 1'b1;
    reg [31:0] cycle = 0;
    reg [63:0] random = 64'h0123_4567_89ab_cdef;
    reg halt = 0;
    reg [23:0] rates_unit_period = 0;
    reg [23:0] rates_scan_period = 0;
    reg [23:0] rates_ck_period = 0;
    reg [23:0] rates_sample_period = 0;
    reg pulse_command = 0;
    reg [11:0] pulse_base = 0;
    reg [11:0] pulse_last = 0;
    reg pulse_run = 0;
    reg pulse_now = 0;
    reg pulse_write = 0;
    reg [2:0] pulse_write_axis = 0;
    reg [11:0] pulse_write_address = 0;
    reg [15:0] pulse_write_half_period = 0;
    reg pulse_write_direction = 0;
    reg lines_push = 0;
    reg signed [31:0] lines_target_x = 0;
    reg signed [31:0] lines_target_y = 0;
    reg [31:0] lines_speed = 0;
    reg [11:0] lines_acceleration_time = 0;
    reg [11:0] lines_deceleration_time = 0;
    reg arcs_write = 0;
    reg [4:0] arcs_write_word = 0;
    reg [41:0] arcs_write_data = 0;
    reg arcs_push = 0;
    reg arcs_start = 0;
    reg trajectory_write = 0;
    reg [4:0] trajectory_write_word = 0;
    reg [54:0] trajectory_write_data = 0;
    reg trajectory_push = 0;
    reg trajectory_start = 0;
    reg trajectory_write_begin = 0;
    reg [7:0] trajectory_begin_segment = 0;
    reg [46:0] trajectory_begin_length = 0;
    reg trajectory_write_path = 0;
    reg [11:0] trajectory_path_address = 0;
    reg [54:0] trajectory_path_data = 0;
    reg [7:0] trajectory_last = 0;
    reg signed [46:0] trajectory_path_end = 0;
    reg [15:0] trajectory_gain_1 = 0;
    reg [15:0] trajectory_gain_2 = 0;
    reg [23:0] trajectory_position_gain_x = 0;
    reg [23:0] trajectory_position_gain_y = 0;
    reg [23:0] trajectory_speed_gain_x = 0;
    reg [23:0] trajectory_speed_gain_y = 0;
    reg [23:0] trajectory_integral_gain_x = 0;
    reg [23:0] trajectory_integral_gain_y = 0;
    reg [23:0] trajectory_inertia_x = 0;
    reg [23:0] trajectory_inertia_y = 0;
    reg [15:0] trajectory_limit_x = 0;
    reg [15:0] trajectory_limit_y = 0;
    reg trajectory_a_x = 0;
    reg trajectory_a_y = 0;
    reg trajectory_b_x = 0;
    reg trajectory_b_y = 0;
    reg lift_a = 0;
    reg lift_b = 0;
    reg lift_run = 0;
    reg lift_learn = 0;
    reg [3:0] lift_last_step = 0;
    reg [15:0] lift_standstill = 0;
    reg [15:0] lift_time_out = 0;
    reg [15:0] lift_rest = 0;
    reg [10:0] lift_seed = 0;
    reg lift_write_target = 0;
    reg [3:0] lift_write_step = 0;
    reg signed [23:0] lift_step_target = 0;
    reg [15:0] lift_step_speed = 0;
    wire step_x;
    wire step_y;
    wire dir_x;
    wire dir_y;
    wire pulse_ready;
    wire pulse_busy;
    wire [31:0] counts_x;
    wire [31:0] counts_y;
    wire lines_ready;
    wire lines_busy;
    wire arcs_ready;
    wire arcs_busy;
    wire profile_ready;
    wire profile_busy;
    wire [15:0] torque_x;
    wire [15:0] torque_y;
    wire [30:0] position_x;
    wire [30:0] position_y;
    wire drive;
    wire reverse;
    wire [15:0] speed;
    wire brake;
    wire lift_busy;
    wire fault;

    machine dut (
        .clk (clk),
        .rst (rst),
        .halt (halt),
        .rates_unit_period (rates_unit_period),
        .rates_scan_period (rates_scan_period),
        .rates_ck_period (rates_ck_period),
        .rates_sample_period (rates_sample_period),
        .pulse_command (pulse_command),
        .pulse_base (pulse_base),
        .pulse_last (pulse_last),
        .pulse_run (pulse_run),
        .pulse_now (pulse_now),
        .pulse_write (pulse_write),
        .pulse_write_axis (pulse_write_axis),
        .pulse_write_address (pulse_write_address),
        .pulse_write_half_period (pulse_write_half_period),
        .pulse_write_direction (pulse_write_direction),
        .lines_push (lines_push),
        .lines_target_x (lines_target_x),
        .lines_target_y (lines_target_y),
        .lines_speed (lines_speed),
        .lines_acceleration_time (lines_acceleration_time),
        .lines_deceleration_time (lines_deceleration_time),
        .arcs_write (arcs_write),
        .arcs_write_word (arcs_write_word),
        .arcs_write_data (arcs_write_data),
        .arcs_push (arcs_push),
        .arcs_start (arcs_start),
        .trajectory_write (trajectory_write),
        .trajectory_write_word (trajectory_write_word),
        .trajectory_write_data (trajectory_write_data),
        .trajectory_push (trajectory_push),
        .trajectory_start (trajectory_start),
        .trajectory_write_begin (trajectory_write_begin),
        .trajectory_begin_segment (trajectory_begin_segment),
        .trajectory_begin_length (trajectory_begin_length),
        .trajectory_write_path (trajectory_write_path),
        .trajectory_path_address (trajectory_path_address),
        .trajectory_path_data (trajectory_path_data),
        .trajectory_last (trajectory_last),
        .trajectory_path_end (trajectory_path_end),
        .trajectory_gain_1 (trajectory_gain_1),
        .trajectory_gain_2 (trajectory_gain_2),
        .trajectory_position_gain_x (trajectory_position_gain_x),
        .trajectory_position_gain_y (trajectory_position_gain_y),
        .trajectory_speed_gain_x (trajectory_speed_gain_x),
        .trajectory_speed_gain_y (trajectory_speed_gain_y),
        .trajectory_integral_gain_x (trajectory_integral_gain_x),
        .trajectory_integral_gain_y (trajectory_integral_gain_y),
        .trajectory_inertia_x (trajectory_inertia_x),
        .trajectory_inertia_y (trajectory_inertia_y),
        .trajectory_limit_x (trajectory_limit_x),
        .trajectory_limit_y (trajectory_limit_y),
        .trajectory_a_x (trajectory_a_x),
        .trajectory_a_y (trajectory_a_y),
        .trajectory_b_x (trajectory_b_x),
        .trajectory_b_y (trajectory_b_y),
        .lift_a (lift_a),
        .lift_b (lift_b),
        .lift_run (lift_run),
        .lift_learn (lift_learn),
        .lift_last_step (lift_last_step),
        .lift_standstill (lift_standstill),
        .lift_time_out (lift_time_out),
        .lift_rest (lift_rest),
        .lift_seed (lift_seed),
        .lift_write_target (lift_write_target),
        .lift_write_step (lift_write_step),
        .lift_step_target (lift_step_target),
        .lift_step_speed (lift_step_speed),
        .step_x (step_x),
        .step_y (step_y),
        .dir_x (dir_x),
        .dir_y (dir_y),
        .pulse_ready (pulse_ready),
        .pulse_busy (pulse_busy),
        .counts_x (counts_x),
        .counts_y (counts_y),
        .lines_ready (lines_ready),
        .lines_busy (lines_busy),
        .arcs_ready (arcs_ready),
        .arcs_busy (arcs_busy),
        .profile_ready (profile_ready),
        .profile_busy (profile_busy),
        .torque_x (torque_x),
        .torque_y (torque_y),
        .position_x (position_x),
        .position_y (position_y),
        .drive (drive),
        .reverse (reverse),
        .speed (speed),
        .brake (brake),
        .lift_busy (lift_busy),
        .fault (fault)
    );
    // What nobody sees would be left out.
    assign seen = {31'd0, step_x}
        ^ {31'd0, step_y}
        ^ {31'd0, dir_x}
        ^ {31'd0, dir_y}
        ^ {31'd0, pulse_ready}
        ^ {31'd0, pulse_busy}
        ^ counts_x
        ^ counts_y
        ^ {31'd0, lines_ready}
        ^ {31'd0, lines_busy}
        ^ {31'd0, arcs_ready}
        ^ {31'd0, arcs_busy}
        ^ {31'd0, profile_ready}
        ^ {31'd0, profile_busy}
        ^ {16'd0, torque_x}
        ^ {16'd0, torque_y}
        ^ {1'd0, position_x}
        ^ {1'd0, position_y}
        ^ {31'd0, drive}
        ^ {31'd0, reverse}
        ^ {16'd0, speed}
        ^ {31'd0, brake}
        ^ {31'd0, lift_busy}
        ^ {31'd0, fault};

    always @(posedge clk) begin
        cycle <= cycle + 1;
        rst <= cycle < 2;
        random <= {random[58:0], random[63:59]} ^ {random[0], random[63:1]} ^ {32'd0, cycle};
        case (random[6:0])
            7'd0: halt <= random[63];
            7'd1: rates_unit_period <= random[63:40];
            7'd2: rates_scan_period <= random[63:40];
            7'd3: rates_ck_period <= random[63:40];
            7'd4: rates_sample_period <= random[63:40];
            7'd5: pulse_command <= random[63];
            7'd6: pulse_base <= random[63:52];
            7'd7: pulse_last <= random[63:52];
            7'd8: pulse_run <= random[63];
            7'd9: pulse_now <= random[63];
            7'd10: pulse_write <= random[63];
            7'd11: pulse_write_axis <= random[63:61];
            7'd12: pulse_write_address <= random[63:52];
            7'd13: pulse_write_half_period <= random[63:48];
            7'd14: pulse_write_direction <= random[63];
            7'd15: lines_push <= random[63];
            7'd16: lines_target_x <= random[63:32];
            7'd17: lines_target_y <= random[63:32];
            7'd18: lines_speed <= random[63:32];
            7'd19: lines_acceleration_time <= random[63:52];
            7'd20: lines_deceleration_time <= random[63:52];
            7'd21: arcs_write <= random[63];
            7'd22: arcs_write_word <= random[63:59];
            7'd23: arcs_write_data <= random[63:22];
            7'd24: arcs_push <= random[63];
            7'd25: arcs_start <= random[63];
            7'd26: trajectory_write <= random[63];
            7'd27: trajectory_write_word <= random[63:59];
            7'd28: trajectory_write_data <= random[63:9];
            7'd29: trajectory_push <= random[63];
            7'd30: trajectory_start <= random[63];
            7'd31: trajectory_write_begin <= random[63];
            7'd32: trajectory_begin_segment <= random[63:56];
            7'd33: trajectory_begin_length <= random[63:17];
            7'd34: trajectory_write_path <= random[63];
            7'd35: trajectory_path_address <= random[63:52];
            7'd36: trajectory_path_data <= random[63:9];
            7'd37: trajectory_last <= random[63:56];
            7'd38: trajectory_path_end <= random[63:17];
            7'd39: trajectory_gain_1 <= random[63:48];
            7'd40: trajectory_gain_2 <= random[63:48];
            7'd41: trajectory_position_gain_x <= random[63:40];
            7'd42: trajectory_position_gain_y <= random[63:40];
            7'd43: trajectory_speed_gain_x <= random[63:40];
            7'd44: trajectory_speed_gain_y <= random[63:40];
            7'd45: trajectory_integral_gain_x <= random[63:40];
            7'd46: trajectory_integral_gain_y <= random[63:40];
            7'd47: trajectory_inertia_x <= random[63:40];
            7'd48: trajectory_inertia_y <= random[63:40];
            7'd49: trajectory_limit_x <= random[63:48];
            7'd50: trajectory_limit_y <= random[63:48];
            7'd51: trajectory_a_x <= random[63];
            7'd52: trajectory_a_y <= random[63];
            7'd53: trajectory_b_x <= random[63];
            7'd54: trajectory_b_y <= random[63];
            7'd55: lift_a <= random[63];
            7'd56: lift_b <= random[63];
            7'd57: lift_run <= random[63];
            7'd58: lift_learn <= random[63];
            7'd59: lift_last_step <= random[63:60];
            7'd60: lift_standstill <= random[63:48];
            7'd61: lift_time_out <= random[63:48];
            7'd62: lift_rest <= random[63:48];
            7'd63: lift_seed <= random[63:53];
            7'd64: lift_write_target <= random[63];
            7'd65: lift_write_step <= random[63:60];
            7'd66: lift_step_target <= random[63:40];
            7'd67: lift_step_speed <= random[63:48];
            default: ;
        endcase
    end
endmodule
