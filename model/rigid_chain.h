#pragma once
/// Newton-Euler dynamics of a serial chain whose joints move about or along the z axis of their own
/// frame: the joint forces of a motion, and the mass matrix (paper, II-B).
///
///   M(q) q'' + h(q, q') = F       h: velocity and gravity forces
///
///   q, q', q''   joint position, rate, acceleration    [n]      rad | m ...
///   F            joint force                            [n]      N m | N
///   M            mass matrix                            [n x n]  kg m² | kg m | kg
///
/// All vectors of link i are in its own frame. The arm's parameters may be over another scalar type P than the motion
/// T. Source: Luh, Walker, Paul 1980; Craig, chapter 6; M by composite bodies: Walker, Orin 1982.

#include "transmission/arm_parameters.h"

namespace halyard {

/// Pose of each link in its parent: x_parent = R x + p.
template <class T>
struct ChainPose {
  T R[kMaxJoints][3][3];
  T p[kMaxJoints][3];
};

template <class A, class B, class T>
HALYARD_INLINE void cross_add(const A* a, const B* b, T* sum) {
  sum[0] += a[1] * b[2] - a[2] * b[1];
  sum[1] += a[2] * b[0] - a[0] * b[2];
  sum[2] += a[0] * b[1] - a[1] * b[0];
}

/// out = Rᵀ v: from the parent's frame into the link's.
template <class T>
HALYARD_INLINE void into_link(const T R[3][3], const T* v, T* out) {
  for (int i = 0; i < 3; ++i) out[i] = R[0][i] * v[0] + R[1][i] * v[1] + R[2][i] * v[2];
}

/// out = R v: from the link's frame into the parent's.
template <class T>
HALYARD_INLINE void into_parent(const T R[3][3], const T* v, T* out) {
  for (int i = 0; i < 3; ++i) out[i] = R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2];
}

template <int known = 0, class P, class T>
HALYARD_INLINE ChainPose<T> chain_pose(const ArmParameters<P>& arm, const T* q) {
  const int n = joint_count<known>(arm);
  ChainPose<T> pose;
  for (int i = 0; i < n; ++i) {
    const JointParameters<P>& j = arm.joint[i];
    if (j.type == JointType::revolute) {
      T s, c;
      sin_cos(q[i], s, c);
      for (int r = 0; r < 3; ++r) {
        pose.R[i][r][0] = j.frame_R[r][0] * c + j.frame_R[r][1] * s;
        pose.R[i][r][1] = j.frame_R[r][1] * c - j.frame_R[r][0] * s;
        pose.R[i][r][2] = j.frame_R[r][2];
        pose.p[i][r] = j.frame_p[r];
      }
    } else {
      for (int r = 0; r < 3; ++r) {
        for (int k = 0; k < 3; ++k) pose.R[i][r][k] = j.frame_R[r][k];
        pose.p[i][r] = j.frame_p[r] + j.frame_R[r][2] * q[i];
      }
    }
  }
  return pose;
}

/// Position of a point of the last link in the base frame, m.
template <class T>
HALYARD_INLINE void position_of(const ArmParameters<T>& arm, const ChainPose<T>& pose, const double* point, T* out) {
  for (int r = 0; r < 3; ++r) out[r] = T(point[r]);
  for (int i = arm.n - 1; i >= 0; --i) {
    T at[3];
    into_parent(pose.R[i], out, at);
    for (int r = 0; r < 3; ++r) out[r] = at[r] + pose.p[i][r];
  }
}

/// Inertia times vector, about the centre of mass.
template <class P, class T>
HALYARD_INLINE void inertia_times(const P* I, const T* w, T* out) {
  out[0] = I[0] * w[0] + I[3] * w[1] + I[4] * w[2];
  out[1] = I[3] * w[0] + I[1] * w[1] + I[5] * w[2];
  out[2] = I[4] * w[0] + I[5] * w[1] + I[2] * w[2];
}

/// Sums the forces f and the moments m of the links from the last link to the base, and sets the force on each joint.
/// Each moment is about the origin of its link's frame.
template <int known = 0, class P, class T>
HALYARD_INLINE void forces_to_joints(const ArmParameters<P>& arm, const ChainPose<T>& pose, T f[][3], T m[][3],
                                     T* force) {
  for (int i = joint_count<known>(arm) - 1; i >= 0; --i) {
    force[i] = arm.joint[i].type == JointType::revolute ? m[i][2] : f[i][2];
    if (i == 0) break;
    T fp[3], mp[3];
    into_parent(pose.R[i], f[i], fp);
    into_parent(pose.R[i], m[i], mp);
    cross_add(pose.p[i], fp, mp);
    for (int k = 0; k < 3; ++k) f[i - 1][k] += fp[k], m[i - 1][k] += mp[k];
  }
}

/// F = M(q) a + h(q, v), h with the arm's gravity.
template <int known = 0, class P, class T>
HALYARD_INLINE void inverse_dynamics(const ArmParameters<P>& arm, const ChainPose<T>& pose, const T* v, const T* a,
                                     T* force) {
  T w[3] = {T(0.0), T(0.0), T(0.0)}, dw[3] = {T(0.0), T(0.0), T(0.0)};
  T acc[3] = {T(-arm.gravity[0]), T(-arm.gravity[1]), T(-arm.gravity[2])};
  T f[kMaxJoints][3], m[kMaxJoints][3];
  const int n = joint_count<known>(arm);
  for (int i = 0; i < n; ++i) {
    const JointParameters<P>& j = arm.joint[i];
    const bool turns = j.type == JointType::revolute;
    T at[3] = {acc[0], acc[1], acc[2]};  // acceleration of this frame's origin, parent's frame
    if (i == 0) {                        // the base does not turn
      into_link(pose.R[0], at, acc);
    } else {
      T wp[3] = {T(0.0), T(0.0), T(0.0)};
      cross_add(w, pose.p[i], wp);
      cross_add(dw, pose.p[i], at);
      cross_add(w, wp, at);
      T w1[3], dw1[3];
      into_link(pose.R[i], w, w1);
      into_link(pose.R[i], dw, dw1);
      into_link(pose.R[i], at, acc);
      if (turns) {
        dw1[0] += w1[1] * v[i];
        dw1[1] -= w1[0] * v[i];
      } else {
        acc[0] += T(2.0) * w1[1] * v[i];
        acc[1] -= T(2.0) * w1[0] * v[i];
      }
      for (int k = 0; k < 3; ++k) w[k] = w1[k], dw[k] = dw1[k];
    }
    if (turns) w[2] += v[i], dw[2] += a[i];
    else acc[2] += a[i];

    T ac[3] = {acc[0], acc[1], acc[2]};
    T wc[3] = {T(0.0), T(0.0), T(0.0)};
    cross_add(w, j.com, wc);
    cross_add(dw, j.com, ac);
    cross_add(w, wc, ac);
    T Iw[3];
    inertia_times(j.inertia, w, Iw);
    inertia_times(j.inertia, dw, m[i]);
    cross_add(w, Iw, m[i]);
    for (int k = 0; k < 3; ++k) f[i][k] = j.mass * ac[k];
    cross_add(j.com, f[i], m[i]);
  }
  forces_to_joints<known>(arm, pose, f, m, force);
}

/// The links from one on to the last, frozen together: mass, first moment and inertia about the origin of that link's
/// frame (entries xx, yy, zz, xy, xz, yz).
template <class T>
struct CompositeBody {
  T mass, moment[3], inertia[6];
};

/// I += m ((c·c) 1 - c cᵀ) for a first moment m c = `moment` and a vector c; with different vectors, symmetrised.
template <class T>
HALYARD_INLINE void add_parallel_axis(const T* moment, const T* c, T* I) {
  const T xx = moment[0] * c[0], yy = moment[1] * c[1], zz = moment[2] * c[2];
  I[0] += yy + zz;
  I[1] += zz + xx;
  I[2] += xx + yy;
  I[3] -= T(0.5) * (moment[0] * c[1] + moment[1] * c[0]);
  I[4] -= T(0.5) * (moment[0] * c[2] + moment[2] * c[0]);
  I[5] -= T(0.5) * (moment[1] * c[2] + moment[2] * c[1]);
}

template <class T>
HALYARD_INLINE CompositeBody<T> body_of(const JointParameters<T>& j) {
  CompositeBody<T> b;
  b.mass = j.mass;
  for (int k = 0; k < 3; ++k) b.moment[k] = j.mass * j.com[k];
  for (int k = 0; k < 6; ++k) b.inertia[k] = j.inertia[k];
  add_parallel_axis(b.moment, j.com, b.inertia);
  return b;
}

/// Adds the child's bodies, whose frame is at p with the rotation R, to the parent's.
template <class T>
HALYARD_INLINE void add_child(const CompositeBody<T>& child, const T R[3][3], const T* p, CompositeBody<T>& parent) {
  const T* I = child.inertia;
  T moment[3], RI[3][3];
  into_parent(R, child.moment, moment);
  for (int r = 0; r < 3; ++r) {
    RI[r][0] = R[r][0] * I[0] + R[r][1] * I[3] + R[r][2] * I[4];
    RI[r][1] = R[r][0] * I[3] + R[r][1] * I[1] + R[r][2] * I[5];
    RI[r][2] = R[r][0] * I[4] + R[r][1] * I[5] + R[r][2] * I[2];
  }
  const auto entry = [&](int r, int c) __attribute__((always_inline)) {
    return RI[r][0] * R[c][0] + RI[r][1] * R[c][1] + RI[r][2] * R[c][2];
  };
  parent.inertia[0] += entry(0, 0);
  parent.inertia[1] += entry(1, 1);
  parent.inertia[2] += entry(2, 2);
  parent.inertia[3] += entry(0, 1);
  parent.inertia[4] += entry(0, 2);
  parent.inertia[5] += entry(1, 2);
  // Steiner's terms of m (c + p) about the parent's origin, less those of m c: m p p + 2 m c p.
  T twice[3];
  for (int k = 0; k < 3; ++k) twice[k] = T(2.0) * moment[k] + child.mass * p[k];
  add_parallel_axis(twice, p, parent.inertia);
  parent.mass += child.mass;
  for (int k = 0; k < 3; ++k) parent.moment[k] += moment[k] + child.mass * p[k];
}

/// M(q). Column c holds the forces of a unit acceleration of joint c, at rest, without gravity: force and moment of the
/// composite body of link c, carried to the joints before it.
template <int known = 0, class T>
HALYARD_INLINE void mass_matrix(const ArmParameters<T>& arm, const ChainPose<T>& pose, T M[][kMaxJoints]) {
  const int n = joint_count<known>(arm);
  CompositeBody<T> body = body_of(arm.joint[n - 1]);
  for (int c = n - 1; c >= 0; --c) {
    const T zero = T(0.0), *m = body.moment;
    const bool turns = arm.joint[c].type == JointType::revolute;
    T f[3] = {turns ? T(-m[1]) : zero, turns ? m[0] : zero, turns ? zero : body.mass};
    T t[3] = {turns ? body.inertia[4] : m[1], turns ? body.inertia[5] : T(-m[0]), turns ? body.inertia[2] : zero};
    for (int i = c; i >= 0; --i) {
      M[i][c] = M[c][i] = arm.joint[i].type == JointType::revolute ? t[2] : f[2];
      if (i == 0) break;
      T fp[3], tp[3];
      into_parent(pose.R[i], f, fp);
      into_parent(pose.R[i], t, tp);
      cross_add(pose.p[i], fp, tp);
      for (int k = 0; k < 3; ++k) f[k] = fp[k], t[k] = tp[k];
    }
    if (c == 0) break;
    CompositeBody<T> parent = body_of(arm.joint[c - 1]);
    add_child(body, pose.R[c], pose.p[c], parent);
    body = parent;
  }
}

/// Replaces a symmetric positive definite A by its factors, A = L D Lᵀ, with 1/D on the diagonal; ldl_solve() then
/// solves A x = b in place for any number of right-hand sides.
template <class T, int Stride>
HALYARD_INLINE void ldl_factor(int n, T A[][Stride]) {
  T D[Stride];
  for (int j = 0; j < n; ++j) {
    T scaled[Stride];  // row j of L D
    D[j] = A[j][j];
    for (int k = 0; k < j; ++k) {
      scaled[k] = A[j][k] * D[k];
      D[j] -= A[j][k] * scaled[k];
    }
    A[j][j] = T(1.0) / D[j];
    for (int i = j + 1; i < n; ++i) {
      T sum = A[i][j];
      for (int k = 0; k < j; ++k) sum -= A[i][k] * scaled[k];
      A[i][j] = sum * A[j][j];
    }
  }
}

template <class T, int Stride>
HALYARD_INLINE void ldl_solve(int n, const T A[][Stride], T* x) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k) x[i] -= A[i][k] * x[k];
  for (int i = 0; i < n; ++i) x[i] *= A[i][i];
  for (int i = n - 1; i >= 0; --i)
    for (int k = i + 1; k < n; ++k) x[i] -= A[k][i] * x[k];
}

}  // namespace halyard
