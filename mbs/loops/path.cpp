#include "mbs/loops/path.hpp"

#include "mbs/model/registers/link.hpp"

#include <algorithm>

namespace cardan {

void path_between(const Model& model, int a, int b, std::vector<PathStep>& out) {
    const auto parent = [&](int body) { return entry(model.links(), body).parent; };
    const auto carries_b = [&](int body) { return body < 0 || (b >= 0 && model.precedes(body, b)); };
    out.clear();
    int common = a;
    for (; !carries_b(common); common = parent(common)) out.push_back({common, -1});
    const auto turn = std::ssize(out);
    for (int body = b; body != common; body = parent(body)) out.push_back({body, 1});
    std::reverse(out.begin() + turn, out.end());
}

}  // namespace cardan
