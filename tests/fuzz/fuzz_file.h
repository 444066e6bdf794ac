#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace lyrefit {

// Folder of this process for inputs of readers that need a file; in memory (/dev/shm) if available.
inline const std::filesystem::path& FuzzFolder() {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path memory("/dev/shm");
    const auto base =
        ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
    const auto path = base / ("lyrefit-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(FuzzFolder(), ignored);
    });
    return path;
  }();
  return folder;
}

// Writes the bytes into a file of FuzzFolder() and returns the path.
inline std::string FuzzFile(const char* name, const std::string& bytes) {
  const std::string path = (FuzzFolder() / name).string();
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) std::abort();
  std::fwrite(bytes.data(), 1, bytes.size(), file);
  std::fclose(file);
  return path;
}

inline std::string Bytes(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace lyrefit
