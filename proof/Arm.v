(* SPDX-License-Identifier: MIT *)
(* The plain arm in binary32, as equations x = fl32 (...), where nothing of its triangle underflows inexactly. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Swivel Require Import Rotors Products Elbow Straight Wrist Rounding Turns Length.
Open Scope R_scope.

Ltac use E H := let e := fresh "e" in let K := fresh "K" in let Q := fresh "Q" in
  match type of E with _ = fl32 ?x => destruct H as [e [K Q]]; rewrite Q in E; clear Q end.

Theorem wrist_rounded w1 w2 w3 L1 L2 sg t0 t3 scale
  x1 x2 x3 x4 wrist2 length height far diff d longer shorter ahead behind a b p m per_sum ca sa ch sh larger smaller lc
    ls l0 l1
  y1 y2 gx y3 y4 gy gz gw  v1 v2 v3' v4 v5 v6 v7 v8 gw2 gx2 gy2 gz2 q0 q1 q2 q3 :
  let S := L1 + L2 in let l := sqrt (w1*w1 + w2*w2 + w3*w3) in
  let reach := Rmin (Rmax l (Rabs (L1 - L2))) S in
  0 < L1 -> 0 < L2 -> 1e-5 <= l -> (sg = 1 \/ sg = -1) -> 0 <= sg * w3 ->
  x1 = fl32 (w1 * w1) -> x2 = fl32 (w2 * w2) -> x3 = fl32 (x1 + x2) -> x4 = fl32 (w3 * w3) -> wrist2 = fl32 (x3 + x4) ->
  length = fl32 (sqrt wrist2) -> height = fl32 (length + sg * w3) ->
  far = fl32 (L1 + L2) -> diff = fl32 (L1 - L2) -> Rabs diff < far -> d = Rmin (Rmax length (Rabs diff)) far ->
  longer = fl32 (far + d) -> shorter = fl32 (far - d) -> ahead = fl32 (d + diff) -> behind = fl32 (d - diff) ->
  a = fl32 (behind * ahead) -> b = fl32 (shorter * longer) -> p = fl32 (ahead * longer) ->
    m = fl32 (behind * shorter) ->
  0 < per_sum ->
  ca = fl32 (a * per_sum) -> sa = fl32 (b * per_sum) -> ch = fl32 (sqrt ca) -> sh = fl32 (sqrt sa) ->
  larger = fl32 (Rmax p m * per_sum) -> smaller = fl32 (ch * sh) ->
  (* the triangle has relative errors alone *)
  relative (length + sg * w3) -> relative (L1 + L2) -> relative (L1 - L2) -> relative (far + d) ->
    relative (far - d) -> relative (d + diff) -> relative (d - diff) ->
  relative (behind * ahead) -> relative (shorter * longer) -> relative (ahead * longer) ->
    relative (behind * shorter) ->
  relative (a * per_sum) -> relative (b * per_sum) -> relative (sqrt ca) -> relative (sqrt sa) ->
    relative (Rmax p m * per_sum) -> relative (ch * sh) ->
  (m <= p /\ lc = larger /\ ls = smaller) \/ (p <= m /\ lc = smaller /\ ls = larger) ->
  lift_q sg lc ls = q4 l0 l1 0 0 ->
  0 < t0*t0 + t3*t3 -> 0 < scale ->
  y1 = fl32 (w1 * t0) -> y2 = fl32 (w2 * t3) -> gx = fl32 (y1 + y2) ->
  y3 = fl32 (w2 * t0) -> y4 = fl32 (w1 * t3) -> gy = fl32 (y3 - y4) ->
  gz = fl32 (sg * height * t0) -> gw = fl32 (- (sg * height * t3)) ->
  v1 = fl32 (gw * l0) -> v2 = fl32 (gx * l1) -> gw2 = fl32 (v1 - v2) ->
  v3' = fl32 (gx * l0) -> v4 = fl32 (gw * l1) -> gx2 = fl32 (v3' + v4) ->
  v5 = fl32 (gy * l0) -> v6 = fl32 (gz * l1) -> gy2 = fl32 (v5 + v6) ->
  v7 = fl32 (gz * l0) -> v8 = fl32 (gy * l1) -> gz2 = fl32 (v7 - v8) ->
  q0 = fl32 (scale * gw2) -> q1 = fl32 (scale * gx2) -> q2 = fl32 (scale * gy2) -> q3 = fl32 (scale * gz2) ->
  (* the rotors on the way are longer than 1e-30 *)
  1e-60 <= q2n (qmul (q4 0 w1 w2 (sg * height)) (q4 t0 0 0 t3)) ->
  1e-60 <= q2n (qmul (q4 gw gx gy gz) (q4 l0 l1 0 0)) ->
  1e-60 <= q2n (qscale scale (q4 gw2 gx2 gy2 gz2)) ->
  w1*w1 + w2*w2 <= 1.00001 * (sg * height * (sg * height)) ->
  vnorm (vsub (wrist_fk (q4 q0 q1 q2 q3) ch sh L1 L2) (vscale (reach / l) (v3 w1 w2 w3))) <= 1.59e-6 * (L1 + L2).
Proof.
  intros S l reach HL1 HL2 Hl5 Hsg Hw3 X1 X2 X3 X4 X5 X6 X7 X8 X9 HD Xd Xlo Xso Xah Xbh Xa Xb Xp Xm Hr Xca Xsa Xch Xsh
    Xlg Xsm
    N1 N2 N3 N4 N5 N6 N7 N8 N9 N10 N11 N12 N13 N14 N15 N16 N17 Hl Hlift Ht Hsc
    Y1 Y2 Y3 Y4 Y5 Y6 Y7 Y8 V1 V2 V3 V4 V5 V6 V7 V8 V9 V10 V11 V12 Q0 Q1 Q2 Q3 B1 B2 B3 Hh.
  assert (El : l*l = w1*w1 + w2*w2 + w3*w3). { unfold l. apply sqrt_sqrt. pose proof (Rle_0_sqr w1).
    pose proof (Rle_0_sqr w2). pose proof (Rle_0_sqr w3). unfold Rsqr in *. lra. }
  pose proof (length_error w1 w2 w3 l x1 x2 x3 x4 wrist2 length Hl5 El X1 X2 X3 X4 X5 X6) as Hlen.
  pose proof (twist_product w1 w2 (sg*height) t0 t3 y1 y2 gx y3 y4 gy gz gw Hh Y1 Y2 Y3 Y4 Y5 Y6 Y7 Y8 B1) as G1.
  pose proof (lift_product (q4 gw gx gy gz) l0 l1 v1 v2 gw2 v3' v4 gx2 v5 v6 gy2 v7 v8 gz2 V1 V2 V3 V4 V5 V6 V7 V8 V9
    V10 V11 V12 B2) as G2.
  pose proof (scaled scale (q4 gw2 gx2 gy2 gz2) q0 q1 q2 q3 Q0 Q1 Q2 Q3 B3) as G3.
  clear X1 X2 X3 X4 X5 X6 Y1 Y2 Y3 Y4 Y5 Y6 Y7 Y8 V1 V2 V3 V4 V5 V6 V7 V8 V9 V10 V11 V12 Q0 Q1 Q2 Q3.
  use X7 N1; use X8 N2; use X9 N3; use Xlo N4; use Xso N5; use Xah N6; use Xbh N7; use Xa N8; use Xb N9; use Xp N10;
    use Xm N11.
  use Xca N12; use Xsa N13; use Xch N14; use Xsh N15; use Xlg N16; use Xsm N17.
  (* e height, e0 far, e1 diff, e2 longer, e3 shorter, e4 ahead, e5 behind, e6 a, e7 b, e8 p, e9 m, e10 ca, e11 sa,
    e12 ch, e13 sh, e14 larger, e15 smaller *)
  assert (Hl' : (m <= p /\ lc = p * per_sum * (1 + e14) /\ ls = smaller) \/ (p <= m /\ lc = smaller /\ ls = m * per_sum
    * (1 + e14))).
  { rewrite Xlg in Hl. destruct Hl as [[Lq [A B]]|[Lq [A B]]]; [left|right]; (split; [exact Lq|]).
    rewrite Rmax_left in A by lra. auto. rewrite Rmax_right in B by lra. auto. }
  assert (Hl0 : 0 < l) by lra.
  pose proof (wrist_core w1 w2 w3 L1 L2 t0 t3 per_sum scale sg length e e0 e1 (q4 gw gx gy gz) (q4 gw2 gx2 gy2 gz2) (q4
    q0 q1 q2 q3)
    e5 e4 e3 e2 e6 e7 e8 e9 e10 e11 e12 e13 e15 e14) as W.
  do 17 (specialize (W ltac:(assumption))).
  do 7 (specialize (W ltac:(assumption))).
  specialize (W Hlen lc ls). cbv zeta in W.
  rewrite <- X8, <- X9, <- Xd in W. rewrite Hlift in W. rewrite <- X7 in W.
  assert (Ebh : Elbow.behind diff d e5 = behind) by (symmetry; exact Xbh).
  assert (Eah : Elbow.ahead diff d e4 = ahead) by (symmetry; exact Xah).
  assert (Eso : Elbow.shorter far d e3 = shorter) by (symmetry; exact Xso).
  assert (Elo : Elbow.longer far d e2 = longer) by (symmetry; exact Xlo).
  assert (Ep : Elbow.p far diff d e4 e2 e8 = p) by (unfold Elbow.p; rewrite Eah, Elo; symmetry; exact Xp).
  assert (Em : Elbow.m far diff d e5 e3 e9 = m) by (unfold Elbow.m; rewrite Ebh, Eso; symmetry; exact Xm).
  assert (Ech : Elbow.ch diff d e5 e4 e6 e10 e12 per_sum = ch) by (unfold Elbow.ch, Elbow.a;
    rewrite Ebh, Eah, <- Xa, <- Xca; symmetry; exact Xch).
  assert (Esh : Elbow.sh far d e3 e2 e7 e11 e13 per_sum = sh) by (unfold Elbow.sh, Elbow.b;
    rewrite Eso, Elo, <- Xb, <- Xsa; symmetry; exact Xsh).
  assert (Esm : Elbow.smaller far diff d e5 e4 e3 e2 e6 e7 e10 e11 e12 e13 e15 per_sum = smaller) by (unfold
    Elbow.smaller; rewrite Ech, Esh; symmetry; exact Xsm).
  rewrite Ep, Em, Esm, Ech, Esh in W.
  exact (W Hl' Hl0 HD G1 G2 G3).
Qed.
