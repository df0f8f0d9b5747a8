-- Testbench of enable_counter.
--
-- Applies enable_counter.stimulus, a line a tick.
-- A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
-- is what stands before a rising edge of clk; inputs change with its falling edge.
--
-- Compares the output ports with enable_counter.expected, a line a tick.
-- A line is a hexadecimal word: the output ports side by side, the first lowest. The last line
-- printed begins with PASS, or lines begin with FAIL and the exit code is not zero.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.env.finish;
use std.textio.all;

entity enable_counter_tb is
end entity enable_counter_tb;

architecture simulation of enable_counter_tb is

    constant HALF_PERIOD : time := 500 ns;
    signal clk : std_logic := '0';
    signal stimulus : std_logic_vector(4 downto 0) := (others => '0');
    signal seen : std_logic_vector(0 downto 0);

begin

    dut : entity work.enable_counter
        port map (
            clk => clk,
            rst => stimulus(4),
            period => unsigned(stimulus(3 downto 0)),
            enable => seen(0)
        );

    process
        file stimuli : text;
        variable status : file_open_status;
        variable text_line : line;
        variable good : boolean;
        variable word : std_logic_vector(4 downto 0);
        variable tick : natural := 0;
        file golden : text;
        variable expected : std_logic_vector(0 downto 0);
        variable differ : natural := 0;

        procedure print(message : string) is
        begin
            write(output, message & LF);
        end procedure;

        procedure fail(message : string) is
        begin
            print("FAIL: " & message);
            finish(1);
        end procedure;
    begin
        file_open(status, stimuli, "enable_counter.stimulus", read_mode);
        if status /= open_ok then
            fail("enable_counter.stimulus cannot be opened");
        end if;
        file_open(status, golden, "enable_counter.expected", read_mode);
        if status /= open_ok then
            fail("enable_counter.expected cannot be opened");
        end if;
        while not endfile(stimuli) loop
            readline(stimuli, text_line);
            hread(text_line, word, good);
            if not good then
                fail("tick " & to_string(tick)
                    & ": enable_counter.stimulus has no word of "
                    & to_string(word'length) & " bits");
            end if;
            if tick > 0 then
                clk <= '1';
                wait for HALF_PERIOD;
                clk <= '0';
            end if;
            stimulus <= word;
            wait for HALF_PERIOD;
            if endfile(golden) then
                fail("tick " & to_string(tick)
                    & ": enable_counter.expected has no line for it");
            end if;
            readline(golden, text_line);
            hread(text_line, expected, good);
            if not good then
                fail("tick " & to_string(tick)
                    & ": enable_counter.expected has no word of "
                    & to_string(expected'length) & " bits");
            end if;
            if seen /= expected then
                -- The waves show what follows from the first difference.
                if differ = 0 then
                    if seen(0) /= expected(0) then
                        print("FAIL: tick " & to_string(tick) & ": enable is "
                            & to_string(seen(0)) & ", expected "
                            & to_string(expected(0)));
                    end if;
                end if;
                differ := differ + 1;
            end if;
            tick := tick + 1;
        end loop;
        if tick = 0 or not endfile(golden) then
            fail("enable_counter.expected is not of a run of " & to_string(tick) & " ticks");
        end if;
        if differ /= 0 then
            fail("ports out differ in " & to_string(differ) & " of " & to_string(tick)
                & " ticks");
        end if;
        print("PASS: ports out are as expected in all of " & to_string(tick) & " ticks");
        wait;
    end process;

end architecture simulation;
