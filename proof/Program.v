(* SPDX-License-Identifier: MIT *)
(* The operations of solve_plain (core/solve_arm.h), all branches included. The test recorded_program runs the C++
   templates on a number type that writes down each operation, and compares. Comments name the C++ stages. *)
From Coq Require Import String List ZArith.
From Swivel Require Import Operations.
Import ListNotations.
Open Scope string_scope.

(* w: the wrist's target, p: the pole's vector, both from the shoulder; upper and fore: the bones' lengths *)
Definition inputs := ["w1"; "w2"; "w3"; "p1"; "p2"; "p3"; "upper"; "fore"].

Definition program := [
  (* swivel_plane: the wrist and the frame's start *)
  ("w11", Mul "w1" "w1");
  ("w22", Mul "w2" "w2");
  ("w12", Add "w11" "w22");
  ("w33", Mul "w3" "w3");
  ("wrist2", Add "w12" "w33");
  ("length", Sqrt "wrist2");
  ("abs_w3", Abs "w3");
  ("height", Add "length" "abs_w3");
  (* swivel_plane: the normal *)
  ("p2w1", Mul "p2" "w1");
  ("p1w2", Mul "p1" "w2");
  ("nz", Sub "p2w1" "p1w2");
  ("p1w3", Mul "p1" "w3");
  ("p3w1", Mul "p3" "w1");
  ("ny", Sub "p1w3" "p3w1");
  ("p3w2", Mul "p3" "w2");
  ("p2w3", Mul "p2" "w3");
  ("nx", Sub "p3w2" "p2w3");
  ("nxx", Mul "nx" "nx");
  ("nyy", Mul "ny" "ny");
  ("nxy", Add "nxx" "nyy");
  ("nzz", Mul "nz" "nz");
  ("normal2", Add "nxy" "nzz");
  ("normal_length", Sqrt "normal2");
  ("per_length2", PerPower "wrist2");
  (* swivel_plane: where it holds *)
  ("abs_p1", Abs "p1");
  ("abs_p2", Abs "p2");
  ("p12", Add "abs_p1" "abs_p2");
  ("abs_p3", Abs "p3");
  ("pole1", Add "p12" "abs_p3");
  ("kPlainLeast", Const 9007199 (-53));
  ("lesser", Select (Lt "wrist2" "pole1") "wrist2" "pole1");
  ("wrist_pole", Add "wrist2" "pole1");
  ("far", Add "upper" "fore");
  ("total", Add "wrist_pole" "far");
  ("kPlainMost", Const 546875 6);
  ("length_pole", Mul "length" "pole1");
  ("kPoleOff", Const 8589935 (-33));
  ("off", Mul "kPoleOff" "length_pole");
  (* bend_elbow: the distance *)
  ("diff", Sub "upper" "fore");
  ("near", Abs "diff");
  ("not_near", Select (Lt "near" "length") "length" "near");
  ("distance", Select (Lt "not_near" "far") "not_near" "far");
  (* arm_triangle *)
  ("longer", Add "far" "distance");
  ("shorter", Sub "far" "distance");
  ("ahead", Add "distance" "diff");
  ("behind", Sub "distance" "diff");
  ("a", Mul "behind" "ahead");
  ("b", Mul "shorter" "longer");
  ("p", Mul "ahead" "longer");
  ("m", Mul "behind" "shorter");
  ("sum", Add "a" "b");
  ("one", Const 1 0);
  ("per_sum", Div "one" "sum");
  ("cos2", Mul "a" "per_sum");
  ("cos_half", Sqrt "cos2");
  ("sin2", Mul "b" "per_sum");
  ("sin_half", Sqrt "sin2");
  ("top", Select (Lt "m" "p") "p" "m");
  ("larger", Mul "top" "per_sum");
  ("smaller", Mul "cos_half" "sin_half");
  ("both", Add "p" "m");
  ("ratio", Mul "both" "per_sum");
  ("lift2", Mul "larger" "ratio");
  ("cos_lift", Sub "p" "m");
  (* bend_elbow: the lift, and where it holds *)
  ("zero", Const 0 0);
  ("lift_side", Flip "cos_lift" "w3");
  ("first", Select (Le "zero" "lift_side") "larger" "smaller");
  ("second", Select (Le "zero" "lift_side") "smaller" "larger");
  ("lift_cos", Flip "first" "w3");
  ("shortest2", Sub "far" "near");
  ("middle_half2", Mul "length" "height");
  ("lifted", Mul "middle_half2" "lift2");
  ("per_kLeastLift", Const 625 4);
  ("lift_least", Mul "per_kLeastLift" "lifted");
  ("bones_least", Select (Lt "shortest2" "lift_least") "shortest2" "lift_least");
  (* frame_from_start: the twist *)
  ("middle3", Copysign "height" "w3");
  ("mx", Mul "per_length2" "nx");
  ("my", Mul "per_length2" "ny");
  ("mz", Mul "per_length2" "nz");
  ("along", Flip "mz" "w3");
  ("hx", Mul "height" "mx");
  ("along1", Mul "along" "w1");
  ("c", Sub "along1" "hx");
  ("hy", Mul "height" "my");
  ("along2", Mul "along" "w2");
  ("s", Sub "along2" "hy");
  ("per_normal", Mul "per_length2" "normal_length");
  ("spread", Mul "per_normal" "height");
  ("abs_c", Abs "c");
  ("large", Add "spread" "abs_c");
  ("t3", Select (Lt "c" "zero") "large" "s");
  ("t0", Select (Lt "c" "zero") "s" "large");
  (* frame_from_start: the rotor, the middle line times the twist *)
  ("w1t0", Mul "w1" "t0");
  ("w2t3", Mul "w2" "t3");
  ("gx", Add "w2t3" "w1t0");
  ("w2t0", Mul "w2" "t0");
  ("w1t3", Mul "w1" "t3");
  ("gy", Sub "w2t0" "w1t3");
  ("gz", Mul "middle3" "t0");
  ("height_t3", Mul "middle3" "t3");
  ("gw", Neg "height_t3");
  ("large_large", Mul "large" "large");
  ("ss", Mul "s" "s");
  ("twist_len2", Add "large_large" "ss");
  (* turn_shoulder: the scale *)
  ("half_twist", Mul "middle_half2" "twist_len2");
  ("half2", Mul "half_twist" "lift2");
  ("root", Sqrt "half2");
  ("kRoot", Const 11863283 (-24));
  ("scale", Div "kRoot" "root");
  (* turn_shoulder: the rotor, times the lift, times the scale *)
  ("gw_cos", Mul "gw" "lift_cos");
  ("gx_sin", Mul "gx" "second");
  ("ew", Sub "gw_cos" "gx_sin");
  ("gx_cos", Mul "gx" "lift_cos");
  ("gw_sin", Mul "gw" "second");
  ("ex", Add "gw_sin" "gx_cos");
  ("gy_cos", Mul "gy" "lift_cos");
  ("gz_sin", Mul "gz" "second");
  ("ey", Add "gz_sin" "gy_cos");
  ("gz_cos", Mul "gz" "lift_cos");
  ("gy_sin", Mul "gy" "second");
  ("ez", Sub "gz_cos" "gy_sin");
  ("qw", Mul "scale" "ew");
  ("qx", Mul "scale" "ex");
  ("qy", Mul "scale" "ey");
  ("qz", Mul "scale" "ez")
].

Definition holds :=
  And (And (And (Le "kPlainLeast" "lesser")
    (Le "total" "kPlainMost"))
    (Lt "off" "normal_length"))
    (Le "kPlainLeast" "bones_least").
