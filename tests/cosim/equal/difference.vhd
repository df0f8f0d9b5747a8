library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

-- The increment of a position since the last one that was valid.
entity Difference is
    generic (BITS : positive := 32);
    port (
        clk, rst, load, valid : in std_logic;
        from, position : in signed(BITS - 1 downto 0);
        Increment : out signed(BITS - 1 downto 0)
    );
end entity;

architecture rtl of Difference is
    signal Lagged : signed(BITS - 1 downto 0) := (others => '0');
begin
    Increment <= position - Lagged;

    process (clk)
    begin
        if rising_edge(clk) then
            if rst = '1' then
                Lagged <= (others => '0');
            elsif load = '1' then
                Lagged <= from;
            elsif valid = '1' then
                Lagged <= position;
            end if;
        end if;
    end process;
end architecture;
