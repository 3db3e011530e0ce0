"""One driver per table or figure: `build(lab)` asks for the results it needs and returns tables and plots."""
NAMES = ["table2", "table3", "table4", "table5", "figure24", "infill", "ablations", "exactness", "peers", "gaps", "thrifty", "pillars", "solids", "table6"]
