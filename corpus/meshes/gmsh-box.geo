// Two blocks, one on the other, with groups of all dimensions: for corpus/meshes/gmsh-box-*.msh.
h = 0.9;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
lower[] = Extrude {0, 0, 0.7} { Surface{1}; };
upper[] = Extrude {0, 0, 0.3} { Surface{lower[0]}; };
Physical Volume("steel", 7) = {lower[1]};
Physical Volume("air above", 2) = {upper[1]};
Physical Surface("floor #1", 3) = {-1};
Physical Surface("interface", 4) = {lower[0]};
Physical Surface("floor and roof", 9) = {1, upper[0]};
Physical Curve("ridge", 5) = {1};
Physical Point("corner", 6) = {1};
