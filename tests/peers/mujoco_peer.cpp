#include "tests/peers/mujoco_peer.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace cardan::peers {

namespace {

// MuJoCo's own handlers end the program or write a log file. It is C: nothing may be thrown through it.
std::string& complaint() {
    static std::string text;
    return text;
}
void complain(const char* text) {
    complaint() = text;
}
void check() {
    if (!complaint().empty()) throw std::runtime_error("MuJoCo: " + std::exchange(complaint(), {}));
}

struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
    void operator()(mjVFS* files) const {
        mj_deleteFileVFS(files, "tree.xml");
        delete files;
    }
};
using ModelPointer = std::unique_ptr<mjModel, Free>;

ModelPointer load(const std::string& xml) {
    const std::unique_ptr<mjVFS, Free> files(new mjVFS);
    mj_defaultVFS(files.get());
    const int size = static_cast<int>(xml.size());
    if (mj_makeEmptyFileVFS(files.get(), "tree.xml", size) != 0) throw std::runtime_error("MuJoCo: no memory");
    std::memcpy(files->filedata[0], xml.data(), xml.size());
    char error[1000] = "";
    ModelPointer model(mj_loadXML("tree.xml", files.get(), error, sizeof error));
    if (!model) throw PeerRefusal(std::string("MuJoCo: ") + error);
    return model;
}

}  // namespace

struct MujocoPeer::Impl {
    explicit Impl(const std::string& xml) {
        mju_user_error = complain;
        mju_user_warning = complain;
        model = load(xml);
        check();
        data.reset(mj_makeData(model.get()));
        check();
    }

    ModelPointer model;
    std::unique_ptr<mjData, Free> data;

    void set(const double* q, const double* qd) {
        std::copy_n(q, model->nq, data->qpos);
        if (qd != nullptr) std::copy_n(qd, model->nv, data->qvel);
    }
};

MujocoPeer::MujocoPeer(const std::vector<PeerLink>& links, std::array<double, 3> gravity,
                       const std::vector<PeerPin>& pins)
    : impl_(new Impl(mujoco_xml(links, gravity, pins))) {
    int previous = -1;
    for (const std::string& joint : joints()) {
        const int link = std::stoi(joint);
        if (link <= previous) throw PeerRefusal("MuJoCo numbers the coordinates depth first: give the links so");
        previous = link;
    }
}

MujocoPeer::MujocoPeer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

std::unique_ptr<MujocoPeer> MujocoPeer::from_urdf(const std::string& urdf) {
    const std::size_t end = urdf.rfind("</robot>");
    if (end == std::string::npos) throw PeerRefusal("no robot");
    const std::string settings =
        "<mujoco><compiler balanceinertia=\"false\" discardvisual=\"true\" fusestatic=\"false\"/></mujoco>";
    auto impl = std::make_unique<Impl>(std::string(urdf).insert(end, settings));
    mjModel& model = *impl->model;
    model.opt.disableflags |= mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS;
    std::fill_n(model.dof_damping, model.nv, 0.0);
    std::fill_n(model.opt.gravity, 3, 0.0);
    return std::unique_ptr<MujocoPeer>(new MujocoPeer(std::move(impl)));
}

std::vector<std::string> MujocoPeer::joints() const {
    std::vector<std::string> names;
    for (int joint = 0; joint < impl_->model->njnt; ++joint)
        names.emplace_back(mj_id2name(impl_->model.get(), mjOBJ_JOINT, joint));
    return names;
}

MujocoPeer::~MujocoPeer() = default;

void MujocoPeer::metric(const double* q, double* g) {
    impl_->set(q, nullptr);
    mj_fwdPosition(impl_->model.get(), impl_->data.get());
    mj_fullM(impl_->model.get(), g, impl_->data->qM);
    check();
}

void MujocoPeer::inverse_dynamics(const double* q, const double* qd, const double* qdd, double* tau) {
    impl_->set(q, qd);
    mj_fwdPosition(impl_->model.get(), impl_->data.get());
    mj_fwdVelocity(impl_->model.get(), impl_->data.get());
    std::copy_n(qdd, impl_->model->nv, impl_->data->qacc);
    mj_rne(impl_->model.get(), impl_->data.get(), 1, tau);
    check();
}

void MujocoPeer::forward_dynamics(const double* q, const double* qd, const double* Q, double* qdd) {
    impl_->set(q, qd);
    std::copy_n(Q, impl_->model->nv, impl_->data->qfrc_applied);
    mj_forward(impl_->model.get(), impl_->data.get());
    std::copy_n(impl_->data->qacc, impl_->model->nv, qdd);
    check();
}

}  // namespace cardan::peers
