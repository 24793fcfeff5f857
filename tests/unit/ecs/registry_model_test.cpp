#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "gnomon/registry.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::ecs {
namespace {

struct Number {
    std::uint64_t value = 0;
};
struct Word {
    std::vector<int> letters;  // owns memory, so that a wrong move shows under the address sanitizer
};

using Id = std::pair<std::uint32_t, std::uint32_t>;
Id id(Entity e) { return {e.index, e.version}; }

/// What the registry should hold, in the plainest terms.
struct Model {
    std::set<Id> living;
    std::map<Id, std::uint64_t> numbers;
    std::map<Id, std::vector<int>> words;
};

void expect_same(const Registry& r, const Model& m, const std::vector<Entity>& ever, int round) {
    ASSERT_EQ(r.alive_count(), m.living.size()) << "round " << round;
    ASSERT_EQ(r.entities_with<Number>().size(), m.numbers.size()) << "round " << round;
    ASSERT_EQ(r.entities_with<Word>().size(), m.words.size()) << "round " << round;
    for (const Entity e : ever) {
        ASSERT_EQ(r.alive(e), m.living.count(id(e)) == 1) << "round " << round;
        const auto number = m.numbers.find(id(e));
        const Number* got = r.get<Number>(e);
        ASSERT_EQ(got != nullptr, number != m.numbers.end()) << "round " << round;
        if (got) {
            ASSERT_EQ(got->value, number->second) << "round " << round;
        }
        const auto word = m.words.find(id(e));
        const Word* letters = r.get<Word>(e);
        ASSERT_EQ(letters != nullptr, word != m.words.end()) << "round " << round;
        if (letters) {
            ASSERT_EQ(letters->letters, word->second) << "round " << round;
        }
    }
    std::size_t both = 0;
    r.each<Number, Word>([&](Entity e, const Number& n, const Word& w) {
        ++both;
        EXPECT_EQ(n.value, m.numbers.at(id(e)));
        EXPECT_EQ(w.letters, m.words.at(id(e)));
    });
    std::size_t want = 0;
    for (const auto& [key, value] : m.numbers) want += m.words.count(key);
    ASSERT_EQ(both, want) << "round " << round;
}

class Editor {
public:
    explicit Editor(std::uint64_t seed) : random_(seed) {}

    void edit() {
        const Entity e = any();
        const bool living = model.living.count(id(e)) == 1;
        switch (random_() % 8) {
            case 0:
            case 1: {
                const Entity fresh = registry.create();
                ASSERT_TRUE(model.living.insert(id(fresh)).second) << "a living id was handed out again";
                ever.push_back(fresh);
                break;
            }
            case 2:
                destroy(e);
                break;
            case 3:
                if (living) model.numbers[id(e)] = registry.emplace<Number>(e, {random_()}).value;
                break;
            case 4:
                if (living)
                    model.words[id(e)] = registry.emplace<Word>(e, {std::vector<int>(random_() % 9, 5)}).letters;
                break;
            case 5:
                ASSERT_EQ(registry.remove<Number>(e), model.numbers.erase(id(e)) == 1);
                break;
            case 6:
                ASSERT_EQ(registry.remove<Word>(e), model.words.erase(id(e)) == 1);
                break;
            default: {
                const std::uint64_t value = random_();
                const bool patched = registry.patch<Number>(e, [&](Number& n) { n.value = value; });
                ASSERT_EQ(patched, model.numbers.count(id(e)) == 1);
                if (patched) model.numbers[id(e)] = value;
            }
        }
        if (ever.size() > 200) ever.erase(ever.begin());
    }
    std::uint64_t dice() { return random_(); }

    Registry registry;
    Model model;
    std::vector<Entity> ever;  // living and dead

private:
    Entity any() { return ever.empty() ? kNull : ever[random_() % ever.size()]; }
    void destroy(Entity e) {
        registry.destroy(e);
        model.living.erase(id(e));
        model.numbers.erase(id(e));
        model.words.erase(id(e));
    }
    std::mt19937_64 random_;
};

TEST(RegistryModel, RandomEditsLeaveWhatAMapWouldHold) {
    Editor editor(print_seed());
    for (int round = 0; round < 20000; ++round) {
        editor.edit();
        if (HasFatalFailure()) return;
        if (round % 20 == 0) expect_same(editor.registry, editor.model, editor.ever, round);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(editor.model.numbers.size(), 0u);
}

TEST(RegistryModel, AReaderOfTheChangeListAloneKeepsAFaithfulCopy) {
    Editor editor(print_seed());
    ChangeCursor cursor;
    std::map<Id, std::uint64_t> copy;
    int incomplete = 0;
    for (int round = 0; round < 3000; ++round) {
        for (std::uint64_t edits = editor.dice() % 10; edits > 0; --edits) editor.edit();
        if (editor.dice() % 40 == 0) editor.registry.discard_changes();  // unread entries are lost
        const Changes changes = editor.registry.changes<Number>(cursor);
        if (!changes.complete) {
            ++incomplete;
            copy.clear();
            editor.registry.each<Number>([&](Entity e, const Number& n) { copy[id(e)] = n.value; });
        }
        for (const Change& change : changes.entries) {
            if (const Number* n = editor.registry.get<Number>(change.entity)) {
                copy[id(change.entity)] = n->value;
            } else {
                copy.erase(id(change.entity));
            }
        }
        ASSERT_EQ(copy, editor.model.numbers) << "round " << round;
        if (editor.dice() % 3 == 0) editor.registry.discard_changes();
    }
    EXPECT_GT(incomplete, 0);
}

}  // namespace
}  // namespace gnomon::ecs
