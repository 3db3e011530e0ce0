; two layers of 0.2 mm, tracks 0.4 mm wide; the upper perimeter reaches 10 mm beyond the lower one
; nozzle_diameter = 0.4
G90
M83
;LAYER_CHANGE
;TYPE:Perimeter
;WIDTH:0.4
;HEIGHT:0.2
G1 X0 Y0 Z.2 F1200
G1 X10 Y0 E.33
;LAYER_CHANGE
G1 X0 Y0 Z.4
G1 X20 Y0 E.66
;TYPE:Support material
G1 X0 Y0
G1 X0.1 Y0 E.01
M84
