# Small problems that have all that a step may do, in a folder of their own: meshes, and decks by problem and deck. Read
# by scripts that have set $mesh, to strut-mesh.
folder=$(mktemp -d "${TMPDIR:-/tmp}/strut-problems-XXXXXX")
cd "$folder" || exit 1
trap 'rm -rf "$folder"' EXIT

cat > bar.recipe <<END
name    = bar
shape   = cylinder
length  = 0.12
radius  = 0.016
spacing = 0.004
END
"$mesh" bar.recipe bar.g || exit 1
{ cat bar.recipe; echo "method = fitted"; echo "grading = 1.05"; echo "coarsest = 0.006"; } > nodes.recipe
"$mesh" nodes.recipe nodes.g || exit 1

# A lattice of two blocks, 1 below and 2 above, as text: no two points alike, so that a mistake has nowhere to hide.
awk 'BEGIN { h = 0.004; srand(1)
  for (k = 0; k < 20; ++k) for (j = 0; j < 6; ++j) for (i = 0; i < 6; ++i)
    printf "%.17g %.17g %.17g %d %.17g\n", h*(i - 2.5 + 0.1*rand()), h*(j - 2.5 + 0.1*rand()), h*(k + 0.5 + 0.1*rand()),
           k < 10 ? 1 : 2, h*h*h }' > mixed.txt
awk '{ if ($4 == 2) $3 += 0.002; print }' CONVFMT=%.17g mixed.txt > apart.txt

# block NAME BLOCK MATERIAL [true]: a section of Blocks; true: a body of its own. $horizon: its key and value.
block() {
  cat <<END
    <ParameterList name="$1">
      <Parameter name="Block Names" type="string" value="$2"/>
      <Parameter name="Material" type="string" value="$3"/>
      <Parameter $horizon type="double"/>
      $damage
      <Parameter name="Separate Body" type="bool" value="${4:-false}"/>
    </ParameterList>
END
}

contact_section='<ParameterList name="Contact">
    <ParameterList name="Models">
      <ParameterList name="touch">
        <Parameter name="Contact Model" type="string" value="Short Range Force"/>
        <Parameter name="Contact Radius" type="double" value="0.0045"/>
        <Parameter name="Spring Constant" type="double" value="1.0e12"/>
        <Parameter name="Friction Coefficient" type="double" value="0.3"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="Interactions">
      <ParameterList name="each with all">
        <Parameter name="Contact Model" type="string" value="touch"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>'

# The same at surfaces.
contact_of_surfaces=$(printf '%s\n' "$contact_section" |
  sed -e 's/value="Short Range Force"/value="Surface"/' -e '/Contact Radius/d; /Spring Constant/d')

end=3.2e-4  # s, of all problems

# problem NAME: sets what else deck() reads.
problem() {
  contact= damage= crack= tip= head= stabilization= viscosity=0 points=Elements formulation=Correspondence speed=80 horizon='name="Horizon" value="0.0085"'
  solver='<ParameterList name="Verlet"> <Parameter name="Rebalance" type="double" value="1.001"/> </ParameterList>'
  case $1 in
    silling | slow)  # on a lattice
      mesh_type=Exodus mesh_file=bar.g sets= foot=foot blocks=$(block bar all copper)
      stabilization='<Parameter name="Stabilization" type="string" value="Silling"/>' ;;
    bar) mesh_type=Exodus mesh_file=bar.g sets= foot=foot blocks=$(block bar all copper) ;;
    fast)
      mesh_type=Exodus mesh_file=bar.g sets= foot=foot speed=200 blocks=$(block bar all copper) ;;
    nodes)
      mesh_type=Exodus mesh_file=nodes.g sets= foot=foot points=Nodes horizon='name="Horizon Factor" value="1.6"'
      blocks=$(block bar all copper) ;;
    cells)
      mesh_type=Exodus mesh_file=nodes.g sets= foot=foot points=Nodes horizon='name="Horizon Factor" value="1.6"' speed=200
      formulation="Quadratic Correspondence" blocks=$(block bar all copper)
      solver='<ParameterList name="Verlet"> <Parameter name="Rebalance" type="double" value="1.001"/> <Parameter name="Safety Factor" type="double" value="0.4"/> </ParameterList>' ;;
    cracking)  # on a lattice
      mesh_type=Exodus mesh_file=bar.g sets= foot=foot horizon='name="Horizon" value="0.0122"'
      damage='<Parameter name="Damage Model" type="string" value="brittle"/>'
      blocks=$(block bar all copper) ;;
    mixed | mixed-cells | meeting | touching | breaking | softening | tearing | rending | snapping)
      mesh_type="Text File" mesh_file=mixed.txt foot=below
      sets='<ParameterList name="Node Sets">
        <Parameter name="below" type="string" value="z &lt; 0.0045"/>
      </ParameterList>'
      blocks=$(block lower block_1 copper; block upper block_2 steel) ;;
  esac
  case $1 in mixed-cells | breaking | softening) formulation="Quadratic Correspondence" viscosity=0.06 ;; esac
  if [ $1 = slow ]; then  # equilibria; the head is held
    speed=0 stabilization=
    solver='<ParameterList name="QuasiStatic">
      <Parameter name="Number of Load Steps" type="int" value="2"/>
    </ParameterList>'
    sets='<ParameterList name="Node Sets">
        <Parameter name="above" type="string" value="z &gt; 0.11"/>
      </ParameterList>'
    head='<ParameterList name="head">
      <Parameter name="Type" type="string" value="Prescribed Displacement"/>
      <Parameter name="Node Set" type="string" value="above"/>
      <Parameter name="Coordinate" type="string" value="xyz"/>
      <Parameter name="Value" type="double" value="0"/>
    </ParameterList>'
  fi
  case $1 in silling | slow | mixed | mixed-cells | bar | fast | nodes | cells | cracking) return 0 ;; esac
  [ $1 = breaking ] && speed=100 damage='<Parameter name="Damage Model" type="string" value="brittle"/>'
  if [ $1 = softening ]; then  # glass whose stress falls before its bonds break, bonded to copper
    speed=20
    blocks=$(block lower block_1 copper; damage='<Parameter name="Damage Model" type="string" value="cohesive"/>'; block upper block_2 glass)
    return 0
  fi
  if [ $1 = tearing ] || [ $1 = rending ]; then  # copper that fails, bonded to steel that does not
    speed=200 contact=$contact_section
    [ $1 = tearing ] && stabilization='<Parameter name="Stabilization" type="string" value="Silling"/>'
    damage='<Parameter name="Damage Model" type="string" value="ductile"/>'
    blocks=$(block lower block_1 copper; damage=; block upper block_2 steel)
    return 0
  fi
  mesh_file=apart.txt contact=$contact_section viscosity=0.06
  [ $1 = touching ] && contact=$contact_of_surfaces
  if [ $1 = snapping ]; then  # the upper one ordinary, with bonds that break by their energy
    speed=100 damage='<Parameter name="Damage Model" type="string" value="by energy"/>'
    crack='<ParameterList name="Cracks">
      <ParameterList name="down">
        <Parameter name="Direction" type="string" value="0 0 -1"/>
        <Parameter name="Start" type="string" value="0 0 0.08"/>
        <Parameter name="Damage" type="double" value="0.1"/>
      </ParameterList>
    </ParameterList>'
    tip='<Parameter name="Crack_Tip(down)" type="bool" value="true"/>
      <Parameter name="Crack_Speed(down)" type="bool" value="true"/>'
    blocks=$(block upper block_2 steel true; damage=; block lower block_1 copper true)
    return 0
  fi
  blocks=$(block lower block_1 copper true; block upper block_2 steel true)
}

# deck NAME: a deck that writes NAME.e and NAME.csv. The step follows the deformation, so that its estimate is under
# test, too; the foot is held by a motion that grows in time rather than by zero.
deck() {
  flight="<ParameterList name=\"flight\">
      <Parameter name=\"Type\" type=\"string\" value=\"Initial Velocity\"/>
      <Parameter name=\"Coordinate\" type=\"string\" value=\"z\"/>
      <Parameter name=\"Value\" type=\"double\" value=\"-$speed\"/>
    </ParameterList>"
  [ $speed = 0 ] && flight=
  cat <<END
<ParameterList>
  <ParameterList name="Discretization">
    <Parameter name="Type" type="string" value="$mesh_type"/>
    <Parameter name="Input Mesh File" type="string" value="$mesh_file"/>
    <Parameter name="Points" type="string" value="$points"/>
  </ParameterList>
  $sets
  <ParameterList name="Materials">
    <ParameterList name="copper">
      <Parameter name="Material Model" type="string" value="Elastic Plastic Correspondence"/>
      <Parameter name="Formulation" type="string" value="$formulation"/>
      $stabilization
      <Parameter name="Density" type="double" value="8960"/>
      <Parameter name="Young's Modulus" type="double" value="110.0e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.296"/>
      <Parameter name="Yield Stress" type="double" value="50.0e6"/>
      <Parameter name="Linear Viscosity" type="double" value="$viscosity"/>
      <ParameterList name="Hardening">
        <Parameter name="Type" type="string" value="Power Law"/>
        <Parameter name="Reference Strain" type="double" value="0.00218"/>
        <Parameter name="Exponent" type="double" value="0.1"/>
      </ParameterList>
      <ParameterList name="Rate">
        <Parameter name="Type" type="string" value="Power Law"/>
        <Parameter name="Reference Rate" type="double" value="1.0e-3"/>
        <Parameter name="Exponent" type="double" value="0.01"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="steel">
      <Parameter name="Material Model" type="string" value="Elastic"/>
      <Parameter name="Density" type="double" value="7800"/>
      <Parameter name="Young's Modulus" type="double" value="200.0e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.3"/>
    </ParameterList>
    <ParameterList name="glass">
      <Parameter name="Material Model" type="string" value="Elastic Correspondence"/>
      <Parameter name="Formulation" type="string" value="Quadratic Correspondence"/>
      <Parameter name="Density" type="double" value="2500"/>
      <Parameter name="Young's Modulus" type="double" value="70.0e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.22"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Damage Models">
    <ParameterList name="cohesive">
      <Parameter name="Damage Model" type="string" value="Cohesive Crack"/>
      <Parameter name="Fracture Energy" type="double" value="300"/>
    </ParameterList>
    <ParameterList name="brittle">
      <Parameter name="Damage Model" type="string" value="Critical Stretch"/>
      <Parameter name="Critical Stretch" type="double" value="0.02"/>
    </ParameterList>
    <ParameterList name="by energy">
      <Parameter name="Damage Model" type="string" value="Bond Energy"/>
      <Parameter name="Fracture Energy" type="double" value="1.0e3"/>
    </ParameterList>
    <ParameterList name="ductile">
      <Parameter name="Damage Model" type="string" value="Plastic Strain"/>
      <Parameter name="Failure Strain" type="double" value="0.02"/>
      <Parameter name="Fracture Energy" type="double" value="17.0e3"/>
      <Parameter name="Averaging Radius" type="double" value="0.01"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Blocks">
$blocks
  </ParameterList>
  $contact
  <ParameterList name="Boundary Conditions">
    $flight
    <ParameterList name="foot">
      <Parameter name="Type" type="string" value="Prescribed Displacement"/>
      <Parameter name="Node Set" type="string" value="$foot"/>
      <Parameter name="Coordinate" type="string" value="z"/>
      <Parameter name="Value" type="string" value="-2.0*t*(1 + 10*x)"/>
    </ParameterList>
    $head
  </ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Final Time" type="double" value="$end"/>
    $solver
  </ParameterList>
  <ParameterList name="Output">
    <Parameter name="Output Filename" type="string" value="$1.e"/>
    <Parameter name="Output Frequency" type="int" value="50"/>
    <ParameterList name="Output Variables">
      <Parameter name="Displacement" type="bool" value="true"/>
      <Parameter name="Velocity" type="bool" value="true"/>
      <Parameter name="Cauchy_Stress" type="bool" value="true"/>
      <Parameter name="Equivalent_Plastic_Strain" type="bool" value="true"/>
      <Parameter name="Dilatation" type="bool" value="true"/>
      <Parameter name="Damage" type="bool" value="true"/>
      <Parameter name="Fragment" type="bool" value="true"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="History">
    <Parameter name="Filename" type="string" value="$1.csv"/>
    <Parameter name="Frequency" type="int" value="10"/>
    $crack
    <ParameterList name="Variables">
      $tip
      <Parameter name="Max_Displacement" type="bool" value="true"/>
      <Parameter name="Max_Equivalent_Plastic_Strain" type="bool" value="true"/>
      <Parameter name="Max_Von_Mises_Stress" type="bool" value="true"/>
      <Parameter name="Max_Radial_Distance($foot)" type="bool" value="true"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
END
}
