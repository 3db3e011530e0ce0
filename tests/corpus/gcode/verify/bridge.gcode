; a span of 6 mm between two piers
; nozzle_diameter = 0.4
M83
;LAYER_CHANGE
;TYPE:Perimeter
;WIDTH:0.4
;HEIGHT:0.2
G1 X0 Y0 Z.2 F1200
G1 X2 Y0 E.07
G1 X8 Y0
G1 X10 Y0 E.07
;LAYER_CHANGE
G1 X0 Y0 Z.4
;TYPE:Bridge infill
;HEIGHT:0.4
G1 X10 Y0 E.33
M84
