#include "tests/data/data_files.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

fs::path verdict_file() { return source_folder() / "tests/data/verdicts.txt"; }

double process_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

bool is_picture(const std::string& verdict) { return verdict == kSeen || verdict == kNothing || verdict == kOutOfView; }


std::vector<std::string> data_files() {
    std::vector<std::string> names;
    if (!fs::is_directory(data_folder())) return names;
    for (const auto& entry : fs::recursive_directory_iterator(data_folder())) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        names.push_back(fs::relative(entry.path(), data_folder()).generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

Verdicts recorded_verdicts() {
    Verdicts verdicts;
    std::ifstream stream(verdict_file());
    for (std::string line; std::getline(stream, line);) {
        const std::size_t space = line.rfind(' ');
        if (line.empty() || line[0] == '#' || space == std::string::npos) continue;
        verdicts[line.substr(0, space)] = line.substr(space + 1);
    }
    return verdicts;
}

void record_verdicts(const Verdicts& verdicts) {
    std::ofstream stream(verdict_file());
    stream
        << "# What becomes of each glTF file of the test data: what its picture shows (seen: a surface; nothing: the\n"
           "# scene places no triangle; out_of_view: it does, but no pixel shows one), or the rule that refuses it.\n"
           "# Written by GNOMON_RECORD_VERDICTS=1 gl_data\n";
    for (const auto& [name, verdict] : verdicts) stream << name << ' ' << verdict << '\n';
}

Watchdog::Watchdog(double most_process_s)
    : most_process_s_(most_process_s), start_(std::chrono::steady_clock::now()), thread_([this] { run(); }) {}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Watchdog::watch(const std::string& file) {
    const std::lock_guard lock(mutex_);
    file_ = file;
    process_start_s_ = process_s();
    start_ = std::chrono::steady_clock::now();
}

void Watchdog::run() {
    constexpr double kClockPerProcess = 6.0;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::milliseconds(200), [this] { return done_; })) {
        const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
        const double process = process_s() - process_start_s_;
        if (file_.empty() || (process < most_process_s_ && clock.count() < kClockPerProcess * most_process_s_))
            continue;
        std::fprintf(stderr, "%s hangs: %.1f s of processor time, %.1f s by the clock\n", file_.c_str(), process,
                     clock.count());
        std::_Exit(EXIT_FAILURE);
    }
}

}  // namespace gnomon::test
