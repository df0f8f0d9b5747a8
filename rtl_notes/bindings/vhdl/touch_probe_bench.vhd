-- Drives touch_probe with random operations and positions. The bench checks nothing; the checker
-- beside the design does.

library ieee;
use ieee.std_logic_1164.all;
use ieee.math_real.all;
use ieee.numeric_std.all;

entity touch_probe_bench is
end entity touch_probe_bench;

architecture simulation of touch_probe_bench is
    signal clk : std_logic := '0';
    signal rst : std_logic := '1';
    signal active, effect, taken : std_logic := '0';
    signal position, present, measured : signed(23 downto 0) := (others => '0');
begin

    dut : entity work.touch_probe
        port map (
            clk => clk, rst => rst, active => active, effect => effect,
            position => position, present => present, taken => taken, measured => measured
        );

    check : entity work.touch_probe_checker
        port map (
            clk => clk, rst => rst, active => active, effect => effect,
            position => position, present => present, taken => taken, measured => measured
        );

    process
        variable first, second : positive := 1;

        impure function one_in(count : positive) return std_logic is
            variable random : real;
        begin
            uniform(first, second, random);
            if random * real(count) < 1.0 then
                return '1';
            end if;
            return '0';
        end function;
    begin
        for tick in 1 to 20000 loop
            wait for 5 ns;
            clk <= '1';
            wait for 5 ns;
            clk <= '0';
            rst <= one_in(500) when tick > 3 else '1';
            active <= active xor one_in(20);
            effect <= one_in(8);
            position <= position + 3;
            present <= present - 1;
        end loop;
        wait;
    end process;

end architecture simulation;
