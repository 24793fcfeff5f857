#include "bench/sweep/resume_log.h"

#include <iterator>
#include <span>

#include "bench/sweep/sweep_json.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json to_json(const std::vector<LightTimes>& lights) {
    Json all = Json::array();
    for (const LightTimes& t : lights) all.push_back({to_json(t.drawn_us), to_json(t.kept_us), to_json(t.cpu_us)});
    return all;
}

std::vector<LightTimes> times_from(const Json& json) {
    const auto number = [](const Json& value) {
        return value.is_null() ? std::nullopt : std::optional(value.get<double>());
    };
    std::vector<LightTimes> all;
    for (const Json& t : json) all.push_back({number(t.at(0)), number(t.at(1)), number(t.at(2))});
    return all;
}

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

Result<SweepJournal> SweepJournal::open(const std::filesystem::path& file, const std::string& header) {
    SweepJournal journal(file);
    std::string text;
    {
        std::ifstream in(file, std::ios::binary);
        if (in) text.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::string whole;  // lines that are known to be good
    if (text.starts_with(header + "\n")) {
        whole = header + "\n";
        for (std::size_t at = whole.size(), end = text.find('\n', at); end != std::string::npos;
             at = end + 1, end = text.find('\n', at)) {
            const std::string line = text.substr(at, end - at);
            try {
                journal.take(line);
            } catch (const Json::exception&) {
                break;
            }
            whole += line + "\n";
        }
    } else {
        whole = header + "\n";
    }
    if (auto error = game::write_file(file, std::as_bytes(std::span(whole)))) return *error;
    return journal;
}

void SweepJournal::take(const std::string& line) {
    const Json json = Json::parse(line);
    const double spent_s = json.at("s").get<double>();
    if (json.contains("round")) {
        timed_.push_back({json.at("row").get<std::string>(), json.at("round").get<std::uint32_t>(),
                          times_from(json.at("times")), times_from(json.at("base"))});
        timed_s_ += spent_s;
    } else {
        JudgedRow row{json.at("row").get<std::string>(), std::nullopt, {}};
        if (!json.at("error").is_null()) row.error = json.at("error").get<std::string>();
        for (const Json& light : json.at("lights")) row.lights.push_back(light_row_from(light));
        judged_.push_back(std::move(row));
    }
    spent_s_ += spent_s;
}

std::optional<Error> SweepJournal::append(const std::string& line) {
    std::ofstream out(file_, std::ios::binary | std::ios::app);
    out << line;
    out.flush();
    if (!out) return Error{"cannot write", file_.string(), "", "output.write"};
    return std::nullopt;
}

std::optional<Error> SweepJournal::add(const JudgedRow& row, double spent_s) {
    Json lights = Json::array();
    for (const LightRow& light : row.lights) lights.push_back(bench::to_json(light));
    const Json error = row.error ? Json(*row.error) : Json(nullptr);
    judged_.push_back(row);
    spent_s_ += spent_s;
    return append(line_of({{"row", row.name}, {"s", spent_s}, {"error", error}, {"lights", lights}}));
}

std::optional<Error> SweepJournal::add(const TimedRow& row, double spent_s) {
    timed_.push_back(row);
    spent_s_ += spent_s;
    timed_s_ += spent_s;
    return append(line_of({{"row", row.row},
                           {"round", row.round},
                           {"s", spent_s},
                           {"times", to_json(row.times)},
                           {"base", to_json(row.base)}}));
}

}  // namespace gnomon::bench
