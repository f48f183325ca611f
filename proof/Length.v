(* SPDX-License-Identifier: MIT *)
(* The wrist's length in binary32, squares that underflow included. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Swivel Require Import Rotors Products Elbow Wrist Rounding.
Open Scope R_scope.

Lemma length_error w1 w2 w3 l x1 x2 x3 x4 wrist2 length : 1e-5 <= l -> l*l = w1*w1+w2*w2+w3*w3 ->
  x1 = fl32 (w1*w1) -> x2 = fl32 (w2*w2) -> x3 = fl32 (x1 + x2) -> x4 = fl32 (w3*w3) -> wrist2 = fl32 (x3 + x4) ->
    length = fl32 (sqrt wrist2) ->
  Rabs (length - l) <= 2.511 * u * l.
Proof.
  intros Hl El X1 X2 X3 X4 X5 X6.
  destruct (fl32_ok (w1*w1)) as [a1 [h1 [K1 [E1 Q1]]]]. destruct (fl32_ok (w2*w2)) as [a2 [h2 [K2 [E2 Q2]]]].
    destruct (fl32_ok (x1+x2)) as [a3 [h3 [K3 [E3 Q3]]]].
  destruct (fl32_ok (w3*w3)) as [a4 [h4 [K4 [E4 Q4]]]]. destruct (fl32_ok (x3+x4)) as [a5 [h5 [K5 [E5 Q5]]]].
    destruct (fl32_ok (sqrt wrist2)) as [a6 [h6 [K6 [E6 Q6]]]].
  rewrite Q1 in X1. rewrite Q2 in X2. rewrite Q3 in X3. rewrite Q4 in X4. rewrite Q5 in X5. rewrite Q6 in X6.
    clear Q1 Q2 Q3 Q4 Q5 Q6.
  apply ok_low in K1. apply ok_low in K2. apply ok_low in K3. apply ok_low in K4. apply ok_low in K5.
    apply ok_low in K6.
  assert (B : forall a b, Rabs a <= b -> -b <= a <= b) by (intros a b H; unfold Rabs in H; destruct (Rcase_abs a); lra).
  apply B in E1. apply B in E2. apply B in E3. apply B in E4. apply B in E5. apply B in E6. unfold eta in *.
    pose proof u_val as U.
  set (lo := 1 - u) in *. set (hi := 1 + u) in *.
  assert (Plo : 0.9999999 < lo < 1) by (unfold lo; lra). assert (Phi : 1 < hi < 1.0000001) by (unfold hi; lra).
  pose proof (Rle_0_sqr w1) as P1. pose proof (Rle_0_sqr w2) as P2. pose proof (Rle_0_sqr w3) as P3. unfold Rsqr in *.
  set (A := w1*w1) in *. set (Bb := w2*w2) in *. set (C := w3*w3) in *.
  assert (T : forall X c h, 0 <= X -> lo <= 1 + c <= hi -> - (1e-45) <= h <= 1e-45 ->
    X*lo - 1e-45 <= X*(1+c) + h <= X*hi + 1e-45).
  { intros X c h HX Hc Hh. assert (X*lo <= X*(1+c)) by (apply Rmult_le_compat_l; lra).
    assert (X*(1+c) <= X*hi) by (apply Rmult_le_compat_l; lra). lra. }
  assert (T' : forall X Y c h, Y <= X -> lo <= 1 + c <= hi -> - (1e-45) <= h <= 1e-45 -> 0 <= X ->
    X*(1+c) + h <= X*hi + 1e-45).
  { intros X Y c h _ Hc Hh HX. pose proof (T X c h HX Hc Hh). lra. }
  pose proof (T A a1 h1 P1 K1 E1) as I1. pose proof (T Bb a2 h2 P2 K2 E2) as I2. pose proof (T C a4 h4 P3 K4 E4) as I4.
  rewrite <- X1 in I1. rewrite <- X2 in I2. rewrite <- X4 in I4.
  (* bounds of x3 and wrist2, with -2e-45 for the least sum *)
  set (s3 := x1 + x2) in *. assert (J3 : (A + Bb)*lo - 2e-45 <= s3 <= (A + Bb)*hi + 2e-45) by (unfold s3; lra).
  assert (M : forall X c p q, p <= X <= q -> 0 <= p + 1e-44 -> lo <= 1+c <= hi ->
    p*lo - 2e-51 <= X*(1+c) <= q*hi + 2e-51).
  { intros X c p q HX Hp Hc.
    assert (F1 : (p + 1e-44)*lo <= (X + 1e-44)*(1+c)) by (apply Rmult_le_compat; lra).
    assert (F2 : (X + 1e-44)*(1+c) <= (q + 1e-44)*hi) by (apply Rmult_le_compat; lra).
    assert (G1 : 1e-44*(1+c) - 1e-44*lo <= 2e-51) by (unfold lo, hi in *; rewrite U in *; lra).
    assert (G2 : 1e-44*hi - 1e-44*(1+c) <= 2e-51) by (unfold lo, hi in *; rewrite U in *; lra). lra. }
  assert (PAB : 0 <= (A+Bb)*lo) by (apply Rmult_le_pos; lra). assert (PC : 0 <= C*lo) by (apply Rmult_le_pos; lra).
  pose proof (M s3 a3 _ _ J3 ltac:(lra) K3) as I3.
  set (s5 := x3 + x4) in *.
  assert (J5 : (A+Bb)*(lo*lo) + C*lo - 1e-44 <= s5 <= (A+Bb)*(hi*hi) + C*hi + 1e-44) by (unfold s5; rewrite X3;
    clear - I3 E3 I4 Plo Phi; lra).
  assert (PAB2 : 0 <= (A+Bb)*(lo*lo)) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]).
  pose proof (M s5 a5 _ _ J5 ltac:(lra) K5) as I5. rewrite X5 in *.
  set (W := s5 * (1+a5) + h5) in *.
  assert (L2 : 1e-10 <= l*l) by (clear -Hl; replace 1e-10 with (1e-5*1e-5) by lra; apply Rmult_le_compat; lra).
  assert (UP : W <= l*l*(1 + 3.0001*u)).
  { assert (hi*hi*hi <= 1 + 3.00001*u) by (unfold hi; rewrite U; lra).
    assert (hi*hi <= 1 + 3.00001*u) by (unfold hi; rewrite U; lra).
    assert ((A+Bb)*(hi*hi*hi) <= (A+Bb)*(1+3.00001*u)) by (apply Rmult_le_compat_l; lra).
      assert (C*(hi*hi) <= C*(1+3.00001*u)) by (apply Rmult_le_compat_l; lra).
    assert (W <= (A+Bb+C)*(1+3.00001*u) + 3e-44) by (unfold W; clear - I5 E5 H1 H2 Plo Phi; lra).
    rewrite <- El in *. rewrite U in *. clear - H3 L2. lra. }
  assert (LO : l*l*(1 - 3.0001*u) <= W).
  { assert (1 - 3*u <= lo*lo*lo) by (unfold lo; rewrite U; lra).
    assert (1 - 3*u <= lo*lo) by (unfold lo; rewrite U; lra).
    assert ((A+Bb)*(1-3*u) <= (A+Bb)*(lo*lo*lo)) by (apply Rmult_le_compat_l; lra).
      assert (C*(1-3*u) <= C*(lo*lo)) by (apply Rmult_le_compat_l; lra).
    assert ((A+Bb+C)*(1-3*u) - 3e-44 <= W) by (unfold W; clear - I5 E5 H1 H2 Plo Phi; lra).
    rewrite <- El in *. rewrite U in *. clear - H3 L2. lra. }
  assert (S1 : sqrt W <= l*(1 + 3.0001*u/2)) by (eapply Rle_trans; [apply sqrt_le_1_alt; exact UP|apply sqrt_lin;
    rewrite ?U; lra]).
  assert (S2 : l*(1 - 0.501*(3.0001*u)) <= sqrt W) by (eapply Rle_trans; [|apply sqrt_le_1_alt; exact LO];
    apply sqrt_low; rewrite ?U; lra).
  rewrite X6. pose proof (sqrt_pos W) as PS. pose proof (T (sqrt W) a6 h6 PS K6 E6) as I6.
  assert (V1 : sqrt W*hi <= l*(1+3.0001*u/2)*hi) by (apply Rmult_le_compat_r; lra).
    assert (V2 : l*(1 - 0.501*(3.0001*u))*lo <= sqrt W*lo) by (apply Rmult_le_compat_r; lra).
  clear - I6 V1 V2 Hl U Plo Phi. unfold lo, hi in *. rewrite U in *. apply Rabs_le. lra.
Qed.
