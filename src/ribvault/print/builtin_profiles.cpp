// The paper's printers: "Orange models have been printed on an Ultimaker 3 using PLA plastic; white models on a Prima
// P120 using PLA; the blue Buddha on a eMotion Tech MicroDelta Rework; the giant octopus on a CR-10 printer; the yellow
// Moai on a Ultimaker 2" (Section 5), all with a 0.4 mm nozzle and 0.2 mm layers; retraction 3 mm and 5 % prime surplus
// from Section 5.1. Sizes and filament are the makers'; speeds, accelerations and PLA temperatures are sensible values,
// not the paper's.
#include "ribvault/print/printer_profile.hpp"

namespace ribvault {

const std::vector<BuiltinProfile>& builtin_profiles() {
    static const std::vector<BuiltinProfile> profiles{
        {"generic", R"(name = generic
nozzle_temperature = 205
bed_temperature = 60
)"},
        {"ultimaker2", R"(name = Ultimaker 2
flavour = marlin
bed = 223,223,205
filament_diameter = 2.85
nozzle_temperature = 210
bed_temperature = 60
retraction = 5.5
retraction_speed = 25
print_acceleration = 3000
travel_acceleration = 3000
retract_acceleration = 3000
max_speed = 300,300,40,45
jerk = 20,20,0.4,5
start_gcode = G28 ; home
start_gcode = G1 Z15 F9000
start_gcode = G92 E0
start_gcode = G1 F200 E10 ; fill the nozzle
start_gcode = G92 E0
end_gcode = G90
end_gcode = G0 Z{park_z} F600
end_gcode = G28 X0 Y0
)"},
        // The firmware refuses files without this header.
        {"ultimaker3", R"(name = Ultimaker 3
flavour = marlin
bed = 215,215,200
filament_diameter = 2.85
nozzle_temperature = 205
bed_temperature = 60
retraction = 6.5
retraction_speed = 25
travel_speed = 250
print_acceleration = 3500
travel_acceleration = 5000
retract_acceleration = 3500
max_speed = 300,300,40,45
jerk = 20,20,0.4,5
file_header = ;START_OF_HEADER
file_header = ;HEADER_VERSION:0.1
file_header = ;FLAVOR:Griffin
file_header = ;GENERATOR.NAME:ribvault
file_header = ;GENERATOR.VERSION:1
file_header = ;GENERATOR.BUILD_DATE:2019-01-01
file_header = ;TARGET_MACHINE.NAME:Ultimaker 3
file_header = ;EXTRUDER_TRAIN.0.INITIAL_TEMPERATURE:{first_layer_temperature}
file_header = ;EXTRUDER_TRAIN.0.MATERIAL.VOLUME_USED:{filament_mm3}
file_header = ;EXTRUDER_TRAIN.0.NOZZLE.DIAMETER:{nozzle_diameter}
file_header = ;EXTRUDER_TRAIN.0.NOZZLE.NAME:AA {nozzle_diameter}
file_header = ;BUILD_PLATE.INITIAL_TEMPERATURE:{first_layer_bed_temperature}
file_header = ;PRINT.TIME:{print_seconds}
file_header = ;PRINT.GROUPS:1
file_header = ;PRINT.SIZE.MIN.X:{min_x}
file_header = ;PRINT.SIZE.MIN.Y:{min_y}
file_header = ;PRINT.SIZE.MIN.Z:{first_layer_height}
file_header = ;PRINT.SIZE.MAX.X:{max_x}
file_header = ;PRINT.SIZE.MAX.Y:{max_y}
file_header = ;PRINT.SIZE.MAX.Z:{max_z}
file_header = ;END_OF_HEADER
start_gcode = T0
start_gcode = G92 E0
start_gcode = G280 S1 ; prime
end_gcode = G90
end_gcode = G0 Z{park_z} F600
thumbnails =
)"},
        {"prima-p120", R"(name = Prima P120
flavour = marlin
bed = 120,120,120
filament_diameter = 1.75
nozzle_temperature = 205
bed_temperature = 60
retraction = 3
retraction_speed = 40
print_speed = 40
support_speed = 50
travel_speed = 100
print_acceleration = 800
travel_acceleration = 800
retract_acceleration = 1500
max_speed = 150,150,1.5,50
max_acceleration = 800,800,20,10000
jerk = 10,10,0.4,5
)"},
        {"cr-10", R"(name = Creality CR-10
flavour = marlin
bed = 300,300,400
filament_diameter = 1.75
nozzle_temperature = 205
bed_temperature = 60
retraction = 5
retraction_speed = 50
print_acceleration = 500
travel_acceleration = 1000
retract_acceleration = 1000
max_speed = 500,500,10,50
max_acceleration = 500,500,100,5000
jerk = 8,8,0.4,5
end_gcode = G90
end_gcode = G0 Z{park_z} F600
end_gcode = G0 X{bed_min_x} Y{bed_max_y} F6000 ; the print comes forward
)"},
        {"microdelta", R"(name = eMotion Tech MicroDelta Rework
flavour = marlin
bed = 150,150,200
round_bed = yes
origin_at_centre = yes
filament_diameter = 1.75
nozzle_temperature = 205
bed_temperature = 0
retraction = 3
retraction_speed = 40
travel_speed = 150
print_acceleration = 1000
travel_acceleration = 1500
retract_acceleration = 1500
max_speed = 200,200,200,50
max_acceleration = 3000,3000,3000,10000
jerk = 10,10,10,5
end_gcode = G28 ; the effector goes up
)"},
    };
    return profiles;
}

}  // namespace ribvault
