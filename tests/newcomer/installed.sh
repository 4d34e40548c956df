# looks_installed PREFIX: man page, completion, what laws of one's own need and the module for Python of an installed tree. Read by scripts with fail.
looks_installed() {
  grep -q 'strut \\- how foams and bars deform' "$1/share/man/man1/strut.1" || fail "the man page does not say what strut does"
  grep -q '\\-\\-continue' "$1/share/man/man1/strut.1" || fail "the man page lacks options"
  bash -c '. "$1/share/bash-completion/completions/strut"; touch one.xml two.txt
    COMP_WORDS=(strut --co) COMP_CWORD=1; _strut; [ "${COMPREPLY[*]}" = --continue ] || exit 1
    COMP_WORDS=(strut --check "") COMP_CWORD=2; _strut; case " ${COMPREPLY[*]} " in *" one.xml "*) ;; *) exit 1 ;; esac
    case " ${COMPREPLY[*]} " in *two.txt*) exit 1 ;; esac' bash "$1" || fail "bash does not complete options and decks"
  for file in materials/strut_law.h materials/abaqus/ABA_PARAM.INC materials/README.md tools/python/README.md; do
    [ -f "$1/share/strut/$file" ] || fail "$file is not installed"
  done
  modules=$1/lib/python3/dist-packages
  [ -d "$modules/strut" ] && /usr/bin/python3 -c 'import numpy, matplotlib, netCDF4' 2> /dev/null || return 0
  cat > module.py << 'END'
import numpy as np, strut
block = strut.voxels(np.ones((4, 4, 6), bool), 1e-3, name="block")
deck = {"Materials": {"m": {"Material Model": "Elastic Correspondence", "Density": 1e3, "Young's Modulus": 1e9, "Poisson's Ratio": 0.3}},
        "Blocks": {"b": {"Block Names": "block", "Material": "m", "Horizon Factor": 1.75}},
        "Boundary Conditions": {"top": {"Type": "Prescribed Velocity", "Node Set": "block_zmax", "Coordinate": "z", "Value": "-1"}},
        "Solver": {"Final Time": 2e-5}, "History": {"Frequency": 1, "Variables": {"Reaction_Z(top)": True}}}
run = strut.run(deck, block)
curve = strut.curve(run, area=16e-6, height=6e-3)
assert run.is_over and len(curve.strain) == len(run.history["Time"]) > 3, curve.text
END
  PYTHONPATH=$modules /usr/bin/python3 module.py > log 2>&1 || fail "the module for Python does not run"
}
