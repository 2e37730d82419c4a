MeshVersionFormatted 2
Dimension
3

SolAtVertices
5
3 1 2 3
0 1 2 4 1 0.0 2 0 -0.0 3
1 1 2 4 2 0.0 2 0 -0.0 3
2 1 2 4 1 0.5 2 0 -0.0 3
4 1 2 4 1 0.0 2 0 -0.25 3
7 1 2 4 2 0.5 2 0 -0.25 3

SolAtTetrahedra
2
1 1
10.5
-11.25
End
