(Seven lines, five of the six corners sharper than a right angle)
G21 G90 G94 F6000
G1 X20 Y0
X3 Y10
X22 Y16
X4 Y25
X23 Y30
X16 Y48
X2 Y62
M2
