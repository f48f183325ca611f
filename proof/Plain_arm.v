(* SPDX-License-Identifier: MIT *)
(* The theorem. An environment e gives each name of Program.v a binary32 value, infinities and NaN included. Let it run
   the program: each name has the value that its operation gives. If its inputs are finite, and the condition `holds` on
   its values is true, then
   - no value of the program is infinite or NaN;
   - the wrist is within 1.59e-6 of the bones' sum from the target, scaled along its ray to the nearest reachable
     distance. The wrist is that of forward kinematics in exact real numbers, with rotors divided by their lengths;
   - the length of the shoulder's rotor differs from 1 by at most 1.1e-6, and the squared length of the elbow's by at
     most 2.985e-7. *)
From Coq Require Import Reals Lra String List.
From Flocq Require Import Core BinarySingleNaN.
From Swivel Require Import Rotors Elbow Operations Program Holds.
Open Scope R_scope.
Open Scope string_scope.

Theorem plain_arm (e : environment) :
  runs e program -> (forall name, In name inputs -> is_finite (e name) = true) -> truth e holds = true ->
  let x name := B2R (e name) in
  let target := v3 (x "w1") (x "w2") (x "w3") in
  let upper := x "upper" in
  let fore := x "fore" in
  let reach := Rmin (Rmax (vnorm target) (Rabs (upper - fore))) (upper + fore) in
  let shoulder := q4 (x "qw") (x "qx") (x "qy") (x "qz") in
  let wrist := wrist_fk shoulder (x "cos_half") (x "sin_half") upper fore in
  Forall (fun line => is_finite (e (fst line)) = true) program /\
  0 < upper /\ 0 < fore /\ 0 < vnorm target /\
  vnorm (vsub wrist (vscale (reach / vnorm target) target)) <= 1.59e-6 * (upper + fore) /\
  Rabs (qnorm shoulder - 1) <= 1.1e-6 /\
  Rabs (x "cos_half" * x "cos_half" + x "sin_half" * x "sin_half" - 1) <= 2.985e-7.
Proof.
  intros run finite_inputs hold x target upper fore reach shoulder wrist.
  split. exact (all_finite e run finite_inputs hold).
  split. exact (proj1 (bones_positive e run finite_inputs hold)).
  split. exact (proj2 (bones_positive e run finite_inputs hold)).
  split. { assert (L : 3e-5 <= vnorm target) by exact (proj1 (l_most e run finite_inputs hold)). lra. }
  split. exact (wrist_bound e run finite_inputs hold).
  split. exact (rotor_length e run finite_inputs hold).
  exact (elbow_length e run finite_inputs hold).
Qed.
Print Assumptions plain_arm.
