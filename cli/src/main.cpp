#include "program.hpp"

int main(int argc, char** argv) { return octetra::cli::run(argc, argv); }
