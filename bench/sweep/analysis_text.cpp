#include "bench/sweep/sweep_json.h"
#include "bench/sweep/sweep_report.h"
#include "bench/text/format_number.h"

namespace gnomon::bench {
namespace {

std::string named(const SceneSweep& sweep, const Choice& choice) {
    return "“" + sweep.plan[choice.row].name + "” (" + percent_words(choice.error) + ", × " +
           factor_words(choice.cost) + ")";
}

/// Why the defaults of a light are above their bound, and what it takes to reach it; nothing if they are not.
std::string missed_words(const SceneSweep& sweep, const std::string& light) {
    const auto missed = missed_by_defaults(sweep, light, SweepCost::drawn);
    if (!missed) return {};
    std::string text = " Above what defaults are to keep: " + promise_words(missed->errors);
    if (missed->sub_texel > 0.0)
        text += "; of the " + count_words(missed->beyond) + " places on edges that are farther off than predicted, " +
                count_words(missed->sub_texel) + " belong to shadows or lights narrower than a texel";
    text += ". ";
    if (!missed->reached) return text + "No row of this sweep reaches it.";
    return text + "Reaching it takes × " + factor_words(missed->reached->cost) + " their time, by “" +
           sweep.plan[missed->reached->row].name + "” (" + percent_words(missed->reached->error) + ").";
}

/// What the defaults of a light take beside a tutorial's; nothing where the sweep has none.
std::string beside_words(const SceneSweep& sweep, const std::string& light) {
    const auto beside = beside_tutorial(sweep, light);
    if (!beside) return {};
    const std::string of =
        " the time of “" + sweep.plan[beside->tutorial.row].name + "” (" + percent_words(beside->tutorial.error) + ")";
    const std::string drawn = "× " + factor_words(beside->drawn);
    if (!beside->kept) return " With every map drawn anew they take " + drawn + of + ".";
    return " With their maps kept, as they are while nothing in them moves, they take × " +
           factor_words(*beside->kept) + of + ", which draws its own in every frame; " + drawn +
           " with every map drawn anew.";
}

std::string sentence(const SceneSweep& sweep, const std::string& light, SweepTruth truth) {
    const HalvingCost found = halving_cost(sweep, light, truth, SweepCost::drawn);
    const char* error = truth == SweepTruth::point ? "wrong pixels" : "error of soft shadows";
    std::string text = light;
    if (found.factor)
        text += ": halving the " + std::string(error) + " multiplies the time by " + factor_words(*found.factor) +
                " on average, from " + named(sweep, found.steps.front().from) + " to " +
                named(sweep, found.steps.back().to) + ". ";
    else
        text += ": no row has half the " + std::string(error) + " of the cheapest. ";
    if (!found.defaults) return text;
    text += "The defaults have " + percent_words(found.defaults->error) + "; ";
    std::string more;
    if (truth == SweepTruth::point) more = missed_words(sweep, light) + beside_words(sweep, light);
    if (!found.from_defaults) return text + "no row halves that." + more;
    return text + "halving that takes × " + factor_words(found.from_defaults->cost_factor()) + " their time, by “" +
           sweep.plan[found.from_defaults->to.row].name + "” (" + percent_words(found.from_defaults->to.error) + ")." +
           more;
}

}  // namespace

std::vector<std::string> halving_sentences(const SceneSweep& sweep) {
    std::vector<std::string> sentences;
    for (const std::string& light : lights_of(sweep))
        for (const SweepTruth truth : kSweepTruths)
            if (!choices(sweep, light, truth, SweepCost::drawn).empty())
                sentences.push_back(sentence(sweep, light, truth));
    return sentences;
}

std::string sweep_summary(const std::vector<SceneSweep>& scenes) {
    std::string text;
    for (const SceneSweep& sweep : scenes) {
        text += "scene   " + sweep.scene + "\ndevice  " + sweep.device + "\npicture " +
                std::to_string(sweep.size_px.x) + " x " + std::to_string(sweep.size_px.y) + "\nrows    " +
                std::to_string(sweep.plan.size()) + ", of all lights " + std::to_string(light_rows(sweep.plan)) +
                ", timed in " + std::to_string(sweep.rounds) + " rounds\n\n";
        for (const std::string& line : halving_sentences(sweep)) text += line + "\n";
        for (std::size_t row = 0; row < sweep.plan.size(); ++row)
            if (sweep.rows[row].error) text += "FAILED " + sweep.plan[row].name + ": " + *sweep.rows[row].error + "\n";
        if (sweep.gl_complaints > 0) text += "OpenGL complained " + std::to_string(sweep.gl_complaints) + " times.\n";
        text += "\n";
    }
    return text;
}

}  // namespace gnomon::bench
