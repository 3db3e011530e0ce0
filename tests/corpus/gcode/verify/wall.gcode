; three layers, one over the other, each shifted by rho exactly: held up
; nozzle_diameter = 0.4
M83
;LAYER_CHANGE
;TYPE:Perimeter
;WIDTH:0.4
;HEIGHT:0.2
G1 X0 Y0 Z.2 F1200
G1 X10 Y0 E.33
;LAYER_CHANGE
G1 X0 Y.2 Z.4
G1 X10 Y.2 E.33
;LAYER_CHANGE
G1 X.2 Y.2 Z.6
G1 X10.2 Y.2 E.33
M84
