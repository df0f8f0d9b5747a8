-- Checker of enable_counter with width=4, made by motion-rtl 0.1.0.
--
-- Compares the ports of a design with the model at every rising edge of clk. All ports are inputs
-- of the checker. At the end of the simulation it prints PASS, FAIL or VACUOUS.
-- The comparison begins with the edge after the first one at which rst is 1, or, with
-- FROM_POWER_ON, with the first edge.
-- Drive the inputs of the design with <= at the edge, or between edges.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity enable_counter_checker is
    generic (
        -- Compares from the first edge on, with the model at power-on.
        FROM_POWER_ON : boolean := false;
        -- File for the model's waves around the first difference, VCD or FST; %m is the name of
        -- the instance. No waves if it is empty.
        WAVES : string := "%m.vcd";
        -- Ports to leave out, separated by commas: output ports are not compared, input ports of
        -- the model stay low. They are connected nevertheless.
        LEAVE : string := ""
    );
    port (
        clk    : in std_logic;            -- Clock.
        rst    : in std_logic;            -- Synchronous reset.
        period : in unsigned(3 downto 0); -- Input: Ticks from one enable to the next; 0 counts as
                                          -- 1.
        enable : in std_logic             -- Output: High in the last tick of the period.
    );
end entity enable_counter_checker;

architecture vhpidirect of enable_counter_checker is
begin

    process
        variable mrtl_checker : integer;
        -- The reset, the input ports and the output ports, the highest bit of each first.
        variable mrtl_ports : std_ulogic_vector(0 to 5);
    begin
        mrtl_checker := work.motion_rtl_pkg.new_checker(
            "0.1.0",
            "enable_counter",
            "width=4",
            "72b84bb17fcdf0c3",
            LEAVE, FROM_POWER_ON, WAVES, enable_counter_checker'path_name);
        loop
            wait until rising_edge(clk);
            mrtl_ports(0) := rst;
            mrtl_ports(1 to 4) := std_ulogic_vector(period);
            mrtl_ports(5) := enable;
            work.motion_rtl_pkg.edge(mrtl_checker, mrtl_ports);
        end loop;
    end process;

end architecture vhpidirect;
