// A target with precompiled headers needs something to compile.
