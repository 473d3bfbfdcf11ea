#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/model/spatial.hpp"
#include "tests/peers/mujoco_peer.hpp"

#include <Eigen/Geometry>

#include <sstream>

namespace cardan::peers {

namespace {

Placement placement_of(const PeerLink& link) {
    return {Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(link.R), Eigen::Map<const Vec3>(link.p)};
}

class Writer {
public:
    explicit Writer(const std::vector<PeerLink>& links) : links_(links), children_(links.size()) {
        for (std::size_t i = 0; i < links.size(); ++i) children_of(links[i].parent).push_back(static_cast<int>(i));
        out_.precision(17);
    }

    std::string write(std::array<double, 3> gravity, const std::vector<PeerPin>& pins) {
        out_ << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"false\" boundmass=\"0\""
             << " boundinertia=\"0\"/><option gravity=\"" << gravity[0] << ' ' << gravity[1] << ' ' << gravity[2]
             << "\"><flag contact=\"disable\" constraint=\"" << (pins.empty() ? "disable" : "enable")
             << "\" warmstart=\"disable\"/></option><worldbody>\n";
        for (const int root : roots_) body(root);
        out_ << "</worldbody>\n";
        if (!pins.empty()) equality(pins);
        out_ << "</mujoco>\n";
        return out_.str();
    }

private:
    std::vector<int>& children_of(int link) { return link < 0 ? roots_ : entry(children_, link); }
    const PeerLink& link(int index) const { return entry(links_, index); }

    void attribute(const char* name, const Eigen::VectorXd& values) {
        out_ << ' ' << name << "=\"" << values.transpose() << '"';
    }
    void rotation(const Mat3& R) {
        const Eigen::Quaterniond q(R);
        attribute("quat", Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    }

    // The links from `first` on to the next with mass are one body of MuJoCo's, with the frame of the last of them.
    void body(int first) {
        std::vector<int> run{first};
        Placement own = placement_of(link(first));  // in the frame of the body before
        while (link(run.back()).is_massless() && link(run.back()).joint != PeerJoint::weld) {
            const std::vector<int>& carried = children_of(run.back());
            if (carried.size() != 1) throw PeerRefusal("MuJoCo: a massless link must carry exactly one other link");
            run.push_back(carried.front());
            own = own * placement_of(link(run.back()));
        }
        out_ << "<body name=\"link " << run.back() << '"';
        attribute("pos", own.p);
        rotation(own.R);
        out_ << ">\n";
        if (!link(run.back()).is_massless()) inertial(link(run.back()));
        joints(run);
        for (const int child : children_of(run.back())) body(child);
        out_ << "</body>\n";
    }

    void joints(const std::vector<int>& run) {
        std::vector<Placement> at(run.size());  // joint frames in that of the body, at q = 0
        for (std::size_t i = run.size() - 1; i-- > 0;) at[i] = at[i + 1] * placement_of(link(run[i + 1])).inverse();
        for (std::size_t i = 0; i < run.size(); ++i) {
            const PeerJoint joint = link(run[i]).joint;
            if (joint == PeerJoint::weld) continue;
            out_ << "<joint name=\"" << run[i] << "\" type=\"" << (joint == PeerJoint::revolute ? "hinge" : "slide")
                 << '"';
            attribute("pos", at[i].p);
            attribute("axis", at[i].R.col(2));
            out_ << "/>\n";
        }
    }

    // As stiff as MuJoCo allows. The place on the second body is where the pin is at q = 0.
    void equality(const std::vector<PeerPin>& pins) {
        out_ << "<equality>\n";
        for (const PeerPin& pin : pins) {
            out_ << "<connect body1=\"link " << pin.a << "\" body2=\"link " << pin.b << '"';
            attribute("anchor", Eigen::Map<const Vec3>(pin.at_a));
            out_ << " solimp=\"0.9999 0.9999 0.001 0.5 2\"/>\n";
        }
        out_ << "</equality>\n";
    }

    void inertial(const PeerLink& link) {
        const double* J = link.J;
        const Mat3 tensor{{J[0], J[3], J[4]}, {J[3], J[1], J[5]}, {J[4], J[5], J[2]}};
        const Eigen::SelfAdjointEigenSolver<Mat3> principal(tensor);
        Mat3 axes = principal.eigenvectors();
        if (axes.determinant() < 0) axes.col(0) *= -1;
        out_ << "<inertial mass=\"" << link.mass << '"';
        attribute("pos", Eigen::Map<const Vec3>(link.com));
        rotation(axes);
        attribute("diaginertia", principal.eigenvalues());
        out_ << "/>\n";
    }

    const std::vector<PeerLink>& links_;
    std::vector<int> roots_;
    std::vector<std::vector<int>> children_;
    std::ostringstream out_;
};

}  // namespace

std::string mujoco_xml(const std::vector<PeerLink>& links, std::array<double, 3> gravity,
                       const std::vector<PeerPin>& pins) {
    return Writer(links).write(gravity, pins);
}

}  // namespace cardan::peers
