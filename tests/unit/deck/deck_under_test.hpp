// A valid deck, for tests that read it unchanged or with one change.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/deck.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::deck {

inline const std::string full_deck = R"xml(<?xml version="1.0"?>
<ParameterList>
  <Parameter name="Verbose" type="bool" value="true"/>
  <ParameterList name="Discretization">
    <Parameter name="Type" type="string" value="Text File"/>
    <Parameter name="Input Mesh File" type="string" value="bar.txt"/>
    <Parameter name="Influence Function" type="string" value="Cubic Decay"/>
    <Parameter name="Degenerate Points" type="string" value="Drop"/>
  </ParameterList>
  <ParameterList name="Node Sets">
    <Parameter name="low" type="string" value="z &lt; 1e-3"/>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="copper">
      <Parameter name="Material Model" type="string" value="Elastic Plastic Correspondence"/>
      <Parameter name="Density" type="int" value="8960"/>
      <Parameter name="Young's Modulus" type="double" value="110e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.296"/>
      <Parameter name="Yield Stress" type="double" value="50e6"/>
      <ParameterList name="Hardening">
        <Parameter name="Type" type="string" value="Power Law"/>
        <Parameter name="Reference Strain" type="double" value="0.00218"/>
        <Parameter name="Exponent" type="double" value="0.1"/>
      </ParameterList>
      <ParameterList name="Rate">
        <Parameter name="Type" type="string" value="Johnson-Cook"/>
        <Parameter name="Reference Rate" type="double" value="2.0"/>
        <Parameter name="Coefficient" type="double" value="0.03"/>
      </ParameterList>
      <Parameter name="Stabilization Coefficient" type="double" value="0.05"/>
    </ParameterList>
    <ParameterList name="steel">
      <Parameter name="Material Model" type="string" value="Elastic Correspondence"/>
      <Parameter name="Density" type="double" value="7800.0"/>
      <Parameter name="Bulk Modulus" type="double" value="160e9"/>
      <Parameter name="Shear Modulus" type="double" value="80e9"/>
      <Parameter name="Stabilization" type="string" value="None"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Blocks">
    <ParameterList name="foam">
      <Parameter name="Block Names" type="string" value="block_1 block_3"/>
      <Parameter name="Material" type="string" value="copper"/>
      <Parameter name="Horizon" type="string" value="0.0065"/>
    </ParameterList>
    <ParameterList name="plate">
      <Parameter name="Block Names" type="string" value="block_2"/>
      <Parameter name="Material" type="string" value="steel"/>
      <Parameter name="Horizon" type="double" value="0.01"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Contact">
    <Parameter name="Search Radius" type="double" value="0.01"/>
    <Parameter name="Search Frequency" type="int" value="50"/>
    <ParameterList name="Models">
      <ParameterList name="touch">
        <Parameter name="Contact Model" type="string" value="Short Range Force"/>
        <Parameter name="Contact Radius" type="double" value="2e-3"/>
        <Parameter name="Spring Constant" type="double" value="1.0e12"/>
        <Parameter name="Friction Coefficient" type="double" value="0.3"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="Interactions">
      <ParameterList name="pair">
        <Parameter name="First Block" type="string" value="block_2"/>
        <Parameter name="Second Block" type="string" value="block_1"/>
        <Parameter name="Contact Model" type="string" value="touch"/>
      </ParameterList>
      <ParameterList name="General Contact">
        <Parameter name="Contact Model" type="string" value="touch"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="flight">
      <Parameter name="Type" type="string" value="Initial Velocity"/>
      <Parameter name="Coordinate" type="string" value="z"/>
      <Parameter name="Value" type="int" value="-50"/>
    </ParameterList>
    <ParameterList name="pull">
      <Parameter name="Type" type="string" value="Prescribed Displacement"/>
      <Parameter name="Node Set" type="string" value="low"/>
      <Parameter name="Coordinate" type="string" value="y"/>
      <Parameter name="Value" type="string" value="1e-3*y*t"/>
    </ParameterList>
    <ParameterList name="wall">
      <Parameter name="Type" type="string" value="Rigid Plane"/>
      <Parameter name="Point" type="string" value="0 0 -1e-3"/>
      <Parameter name="Normal" type="Array(int)" value="{0, 0, 2}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Verbose" type="bool" value="false"/>
    <Parameter name="Initial Time" type="double" value="1e-4"/>
    <Parameter name="Final Time" type="double" value="3e-4"/>
    <Parameter name="Wall Time" type="double" value="3600"/>
    <ParameterList name="Verlet">
      <Parameter name="Fixed dt" type="double" value="1e-8"/>
      <Parameter name="Rebalance" type="double" value="1.5"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <Parameter name="Output File Type" type="string" value="ExodusII"/>
    <Parameter name="Output Filename" type="string" value="bar"/>
    <Parameter name="Output Frequency" type="int" value="100"/>
    <ParameterList name="Output Variables">
      <Parameter name="Displacement" type="bool" value="true"/>
      <Parameter name="Velocity" type="bool" value="false"/>
      <Parameter name="Von_Mises_Stress" type="bool" value="true"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="History">
    <Parameter name="Filename" type="string" value="bar.csv"/>
    <Parameter name="Interval" type="double" value="1e-6"/>
    <ParameterList name="Variables">
      <Parameter name="Max_Displacement" type="bool" value="true"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)xml";

// The shape of the wall in full_deck, to be replaced by another tool's.
inline const std::string wall_shape = R"x("Rigid Plane"/>
      <Parameter name="Point" type="string" value="0 0 -1e-3"/>
      <Parameter name="Normal" type="Array(int)" value="{0, 0, 2}"/>)x";

// Only keys without a default.
inline const std::string small_deck = R"xml(<ParameterList>
  <ParameterList name="Discretization">
    <Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="bar.txt"/>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="copper">
      <Parameter name="Material Model" type="string" value="Elastic Plastic Correspondence"/>
      <Parameter name="Density" type="double" value="8960"/>
      <Parameter name="Young's Modulus" type="double" value="110e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.296"/>
      <Parameter name="Yield Stress" type="double" value="50e6"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Blocks">
    <ParameterList name="foam">
      <Parameter name="Block Names" type="string" value="all"/>
      <Parameter name="Material" type="string" value="copper"/>
      <Parameter name="Horizon" type="double" value="0.0065"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Final Time" type="double" value="2e-4"/>
  </ParameterList>
</ParameterList>
)xml";

// `text` with the first `old` replaced; throws if `old` is missing, because the test is then wrong.
inline std::string changed(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the deck under test does not hold: " + old);
  return text.replace(at, old.size(), replacement);
}

// A folder with decks and the mesh they name.
class DeckFolder {
 public:
  DeckFolder() : folder_(world_) { write("bar.txt", "0 0 0 1 1\n"); }

  const Communicator& world() const { return world_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  void write(const std::string& name, const std::string& text) const {
    run_on_root(world_, [&] { std::ofstream(folder_ / name) << text; });
  }

  Deck read(const std::string& text) const {
    write("deck.xml", text);
    return deck::read(folder_ / "deck.xml", world_);
  }

  // The text of the error, without the deck's path; "" if there is none.
  std::string error(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      return without_folder(error.what());
    }
    return "";
  }

  std::string without_folder(std::string text) const {
    const std::string prefix = (folder_ / "").string();
    for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
    return text;
  }

 private:
  Communicator world_;
  TemporaryFolder folder_;
};

}  // namespace strut::deck
