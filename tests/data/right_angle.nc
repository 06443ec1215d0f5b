(Two lines of 10 mm that meet at a right angle)
G21 G90 G94 F6000
G1 X10 Y0
X10 Y10
M2
