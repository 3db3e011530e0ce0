"""What every figure's script does on the command line: result files in, PDF, SVG and PNG out."""
import argparse
import pathlib
import sys

import look
import results


def run(module):
    """`module` has a docstring, INPUTS (name -> kind of result file, in order) and draw(**results) -> figure."""
    parser = argparse.ArgumentParser(description=module["__doc__"], formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, kind in module["INPUTS"].items():
        parser.add_argument(name, type=pathlib.Path, help=f"result file, {kind}")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="without its ending: .pdf, .svg and .png are written")
    chosen = parser.parse_args()
    try:
        given = {name: results.load(getattr(chosen, name), kind) for name, kind in module["INPUTS"].items()}
        look.save(module["draw"](**given), chosen.output)
    except results.Unusable as error:
        print(f"{pathlib.Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        return 3
    return 0
