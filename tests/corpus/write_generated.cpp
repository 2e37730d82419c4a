/// write_generated MANIFEST PROGRAM FOLDER: makes the generated meshes of the corpus with the
/// program, as the manifest specifies. Programs under mpirun read them from the folder.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    std::ifstream in(argv[1]);
    const std::filesystem::path folder = argv[3];
    std::filesystem::create_directories(folder);
    const nlohmann::json manifest = nlohmann::json::parse(in);
    for (const auto& entry : manifest.at("meshes")) {
        if (!entry.contains("generate")) continue;
        std::string command = std::string("'") + argv[2] + "' generate --quiet";
        for (const std::string word : entry.at("generate")) command += " " + word;
        const std::string name = entry.at("name");
        command += " -o '" + (folder / (name + ".ele")).string() + "'";
        if (std::system(command.c_str()) != 0) {
            std::cerr << "failed: " << command << "\n";
            return 1;
        }
    }
    return 0;
}
