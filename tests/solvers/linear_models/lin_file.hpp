/// @file
/// A reader of OpenFAST's linearisation files: by words, as the toolboxes do.
#pragma once

#include "mbs/base/types.hpp"
#include "tests/support/catch.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace cardan::test {

struct LinFile {
    struct Row {
        double value;
        std::string rotating;
        int order;
        std::string description;
    };
    std::map<std::string, double> head;
    std::map<std::string, std::vector<Row>> tables;
    std::map<std::string, Matrix> matrices;
    std::vector<std::string> lines;

    explicit LinFile(const std::string& path) {
        std::ifstream in(path);
        for (std::string line; std::getline(in, line);) lines.push_back(line);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::size_t colon = lines[i].find(':');
            if (lines[i].starts_with("   ") && colon != std::string::npos && tables.empty())
                head[lines[i].substr(3, colon - 3)] = std::stod(lines[i].substr(colon + 1));
            if (lines[i].starts_with("Order of ")) i = read_table(i, lines[i].substr(9, colon - 9));
            if (colon == 1) i = read_matrix(i);
        }
    }
    std::size_t read_table(std::size_t i, const std::string& name) {
        for (i += 3; !lines[i].empty(); ++i) {
            std::istringstream words(lines[i]);
            std::size_t count = 0;
            Row row;
            words >> count >> row.value >> row.rotating >> row.order >> std::ws;
            std::getline(words, row.description);
            tables[name].push_back(row);
            REQUIRE(count == tables[name].size());
        }
        return i;
    }
    std::size_t read_matrix(std::size_t i) {
        std::istringstream title(lines[i].substr(2));
        Eigen::Index rows = 0, columns = 0;
        char times = 0;
        title >> rows >> times >> columns;
        Matrix& A = matrices[lines[i].substr(0, 1)];
        A.resize(rows, columns);
        for (Eigen::Index r = 0; r < rows; ++r) {
            std::istringstream values(lines[++i]);
            for (Eigen::Index c = 0; c < columns; ++c) values >> A(r, c);
            REQUIRE(values);
        }
        return i;
    }
};

}  // namespace cardan::test
