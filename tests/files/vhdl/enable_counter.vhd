-- enable_counter: divides the reference clock: one tick of enable per period.
-- Made by motion-rtl from the circuit of that name.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity enable_counter is
    port (
        clk    : in  std_logic;
        rst    : in  std_logic;            -- Registers to their power-on values; memories stay.
        period : in  unsigned(3 downto 0); -- Ticks from one enable to the next; 0 counts as 1.
        enable : out std_logic             -- High in the last tick of the period.
    );
end entity enable_counter;

architecture rtl of enable_counter is

    signal count : unsigned(3 downto 0) := (others => '0'); -- Ticks since the period began.

    signal next_s : unsigned(3 downto 0); -- count + 1: ticks of the period, including this one.

begin

    next_s <= count + 1;
    enable <= next_s ?>= period;

    process (clk)
    begin
        if rising_edge(clk) then
            if rst then
                count <= (others => '0');
            elsif enable then
                count <= (others => '0');
            else
                count <= next_s;
            end if;
        end if;
    end process;

end architecture rtl;

# Signals of enable_counter whose names in VHDL are not those in the waves, for `motion-rtl compare --map`.
# The instance is called dut, as in the testbench.

[signals]
"enable_counter.next" = "dut.next_s"
